// Loads a component that is part of the page, so that the page also works as a local file.

import type { Exports, Instantiate, Status } from './wit';
import type { Variable } from './variables';

/** What the page holds of an FMU. */
export interface Embedded {
  name: string;
  token: string;
  variables: Variable[];
  /** Names of the state derivatives, in the FMU's order. */
  derivatives: string[];
  instantiate: Instantiate;
  /** Core modules, compressed, in base 64. */
  modules: Record<string, string>;
}

export interface Message {
  status: Status;
  text: string;
}

/** A component in memory of its own. */
export class Component {
  readonly log: Message[] = [];
  readonly variables: Map<string, Variable>;

  private constructor(
    readonly fmu: Embedded,
    private readonly compiled: Map<string, WebAssembly.Module>,
    private loaded: Exports | undefined,
  ) {
    this.variables = new Map(fmu.variables.map((variable) => [variable.name, variable]));
  }

  static async load(fmu: Embedded): Promise<Component> {
    const compile = async ([path, code]: [string, string]): Promise<[string, WebAssembly.Module]> => [
      path,
      await WebAssembly.compile(await inflated(code)),
    ];
    const modules = await Promise.all(Object.entries(fmu.modules).map(compile));
    return new Component(fmu, new Map(modules), undefined);
  }

  get exports(): Exports {
    this.loaded ??= this.fmu.instantiate((path) => this.module(path), {
      'fmi:fmi3/callbacks': this.callbacks(),
      'fmi:fmi3/callbacks@3.0.0': this.callbacks(),
      'fmi:fmi3/types@3.0.0': {},
    });
    return this.loaded;
  }

  /** After a trap: all instances are lost, the next one gets new memory. */
  renew(): void {
    this.loaded = undefined;
  }

  private module(path: string): WebAssembly.Module {
    const module = this.compiled.get(path);
    if (!module) throw new Error(`the page has no module ${path}`);
    return module;
  }

  private callbacks(): Record<string, unknown> {
    const nothing = (): void => undefined;
    const logMessage = (_name: string, status: Status, _category: string, text: string): void => {
      this.log.push({ status, text });
    };
    return { logMessage, clockUpdate: nothing, lockPreemption: nothing, unlockPreemption: nothing };
  }
}

async function inflated(base64: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}
