// Starts a flight page.

import { element } from '../page/element';
import type { FlightData } from './flight';
import { Replay } from './replay';

new Replay(JSON.parse(element('data', HTMLScriptElement).textContent) as FlightData).run();
