// Starts the page.

import autopilot from 'virtual:ahv_autopilot';
import ahv from 'virtual:ahv';
import manoeuvres from 'virtual:manoeuvres';
import published from 'virtual:published';
import data from 'virtual:vehicle';
import { Component } from './fmu/component';
import { App } from './page/app';
import { element } from './page/element';

async function start(): Promise<void> {
  const [vehicle, pilot] = await Promise.all([Component.load(ahv), autopilot && Component.load(autopilot)]);
  element('flight', HTMLElement).hidden = false;
  element('pictures', HTMLElement).hidden = true;
  document.querySelector('main')!.classList.add('flying');
  new App({ vehicle, autopilot: pilot, data, published, manoeuvres }).run();
}

const missing = (['WebAssembly', 'DecompressionStream'] as const).find((name) => !(name in globalThis));
const say = (text: string): void => {
  element('flight', HTMLElement).hidden = true;
  element('pictures', HTMLElement).hidden = false;
  element('message', HTMLElement).textContent = text;
};
if (missing) say(`This browser has no ${missing}, so the vehicle cannot fly here. These are pictures of flights.`);
else start().catch((error: unknown) => say(`The vehicle cannot fly here: ${String(error)}`));
