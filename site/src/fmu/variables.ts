// Variables as the model description declares them.

export interface Item {
  name: string;
  value: number;
  description?: string;
}

export interface Variable {
  name: string;
  reference: number;
  type: 'real' | 'integer' | 'enumeration' | 'boolean';
  causality: 'independent' | 'parameter' | 'calculatedParameter' | 'input' | 'output' | 'local';
  description: string;
  /** SI. */
  unit: string;
  /** What people read: the value in SI times `factor`. */
  display: { unit: string; factor: number };
  start?: number;
  min?: number;
  max?: number;
  items?: Item[];
}

/** Values by name of variable, in SI; enumerations by number, Booleans as 0 or 1. */
export type Values = Readonly<Record<string, number>>;
