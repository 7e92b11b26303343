// Modules that build.mjs makes from the FMUs and the data files.

declare module 'virtual:ahv' {
  const fmu: import('./fmu/component').Embedded;
  export default fmu;
}

declare module 'virtual:ahv_autopilot' {
  /** Missing in a page that was built without the autopilot. */
  const fmu: import('./fmu/component').Embedded | undefined;
  export default fmu;
}

declare module 'virtual:vehicle' {
  const vehicle: import('./data').VehicleData;
  export default vehicle;
}

declare module 'virtual:published' {
  const published: import('./data').Published;
  export default published;
}

declare module 'virtual:manoeuvres' {
  /** Input files of `cargo ahv fly`. */
  const manoeuvres: string[];
  export default manoeuvres;
}
