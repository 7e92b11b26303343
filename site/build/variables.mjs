// The variables of an FMU, as its model description declares them.

import { XMLParser } from 'fast-xml-parser';

const TYPES = { Float64: 'real', Enumeration: 'enumeration', Boolean: 'boolean', Int64: 'integer' };
const LISTS = new Set(['Unit', 'DisplayUnit', 'Item', 'EnumerationType', 'UInt64', 'UInt32', ...Object.keys(TYPES)]);

const list = (value) => (value === undefined ? [] : [value].flat());

/** Token, variables and continuous states of a model description of FMI 3.0. */
export function described(xml) {
  const parser = new XMLParser({
    ignoreAttributes: false,
    attributeNamePrefix: '',
    parseAttributeValue: false,
    isArray: (name) => LISTS.has(name),
  });
  const model = parser.parse(xml).fmiModelDescription;
  const units = new Map(
    list(model.UnitDefinitions?.Unit).map((unit) => [unit.name, list(unit.DisplayUnit)]),
  );
  const items = new Map(
    list(model.TypeDefinitions?.EnumerationType).map((type) => [
      type.name,
      list(type.Item).map(({ name, value, description }) => ({ name, value: Number(value), description })),
    ]),
  );
  const variables = Object.entries(TYPES).flatMap(([element, type]) =>
    list(model.ModelVariables[element]).map((variable) => variableOf(variable, type, units, items)),
  );
  const byReference = new Map(variables.map((variable) => [variable.reference, variable.name]));
  const states = list(model.ModelStructure.ContinuousStateDerivative).map(({ valueReference }) =>
    byReference.get(Number(valueReference)),
  );
  return { token: model.instantiationToken, name: model.modelName, variables, derivatives: states };
}

function variableOf(variable, type, units, items) {
  const display = units.get(variable.unit)?.find(({ name }) => name === variable.displayUnit);
  const number = (value) => (value === undefined ? undefined : Number(value));
  return {
    name: variable.name,
    reference: Number(variable.valueReference),
    type,
    causality: variable.causality,
    description: variable.description,
    unit: variable.unit ?? '',
    display: { unit: display?.name ?? variable.unit ?? '', factor: Number(display?.factor ?? 1) },
    start: type === 'boolean' ? (variable.start && Number(variable.start === 'true')) : number(variable.start),
    min: number(variable.min),
    max: number(variable.max),
    items: items.get(variable.declaredType),
  };
}
