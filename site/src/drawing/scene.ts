// Draws the vehicle: body, tanks, engine, elevator, shocks and plume.

import type { Shapes } from '../flight/shapes';
import type { Outline, Point } from './outline';
import { View, type Pose } from './pose';
import { shockAngle } from './shock';
import { textSize, type Theme } from './theme';

/** World in the picture, m: the vehicle with room for its shocks. */
const WIDTH_M = 41;
const HEIGHT_M = 17;
/** Before the nose, m. */
const AHEAD_M = 1;
/** A full tank as drawn: the surface stays visible. */
const FULL = 0.85;
const SHOCK_M = 60;
const PLUME_M = 16;
const BAR_M = 5;
/** Most pixels in a row of the picture: beyond them only the work grows. */
const MOST_COLUMNS = 2560;

export interface Look {
  shapes: Shapes | undefined;
  /** Factor on the deformation. */
  magnified: number;
  /** Factor on the displacement of the liquid. */
  liquid: number;
  /** Station of the mass centre, m. */
  massCentre: number;
}

export function draw(canvas: HTMLCanvasElement, outline: Outline, angles: { lower: number; upper: number }, pose: Pose, look: Look, theme: Theme): void {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const pixel = Math.min(window.devicePixelRatio || 1, MOST_COLUMNS / width);
  const [columns, rows] = [Math.round(width * pixel), Math.round(height * pixel)];
  if (canvas.width !== columns || canvas.height !== rows) Object.assign(canvas, { width: columns, height: rows });
  // If each pixel is one of the screen, none is mixed from its neighbours, which costs more than the drawing.
  canvas.style.imageRendering = pixel === window.devicePixelRatio ? 'pixelated' : 'auto';
  // What is opaque hides what is below: the browser need not mix them.
  const context = canvas.getContext('2d', { alpha: false })!;
  context.setTransform(pixel, 0, 0, pixel, 0, 0);
  context.fillStyle = theme.panel;
  context.fillRect(0, 0, width, height);
  const scale = Math.min(width / WIDTH_M, height / HEIGHT_M);
  const centre: Point = [(AHEAD_M + look.massCentre) * scale, height / 2];
  const view = new View(pose, look.shapes, look.magnified, look.massCentre, centre, scale);
  const pen = new Pen(context, theme);
  horizon(pen, width, centre);
  shocks(pen, view, angles, pose);
  plume(pen, view, outline, pose);
  pen.area(outline.body.map((point) => view.place(point)), theme.body, theme.ink);
  tanks(pen, view, outline, pose, look.liquid);
  nacelle(pen, view, outline);
  elevator(pen, view, outline, pose);
  scaleBar(pen, height, scale);
}

class Pen {
  constructor(
    readonly context: CanvasRenderingContext2D,
    readonly theme: Theme,
  ) {}

  line(points: Point[], colour: string, width = 1.5, dash: number[] = []): void {
    this.path(points);
    this.context.setLineDash(dash);
    this.context.strokeStyle = colour;
    this.context.lineWidth = width;
    this.context.stroke();
    this.context.setLineDash([]);
  }

  area(points: Point[], fill: string | CanvasGradient, edge?: string): void {
    this.path(points);
    this.context.fillStyle = fill;
    this.context.fill();
    if (edge) this.line(points, edge);
  }

  text(text: string, [x, y]: Point, align: CanvasTextAlign): void {
    this.context.font = `${textSize(0.75)}px system-ui, sans-serif`;
    this.context.textAlign = align;
    this.context.fillStyle = this.theme.muted;
    this.context.fillText(text, x, y);
  }

  private path(points: Point[]): void {
    this.context.beginPath();
    for (const [x, y] of points) this.context.lineTo(x, y);
  }
}

function horizon(pen: Pen, width: number, [, y]: Point): void {
  pen.line([[0, y], [width, y]], pen.theme.grid, 1, [2, 6]);
}

/** From the nose, at the angle at which the stream there turns; where it does not turn, a Mach wave. */
function shocks(pen: Pen, view: View, angles: { lower: number; upper: number }, pose: Pose): void {
  const nose = view.place([0, 0]);
  const below = shockAngle(pose.mach, angles.lower + pose.alpha_probe);
  const above = shockAngle(pose.mach, angles.upper - pose.alpha_probe);
  const stream = -pose.gamma;
  if (below !== undefined) pen.line([nose, view.aft(nose, SHOCK_M, stream - below)], pen.theme.shock, 2);
  if (above === undefined) return;
  const turns = angles.upper > pose.alpha_probe;
  pen.line([nose, view.aft(nose, SHOCK_M, stream + above)], pen.theme.shock, turns ? 2 : 1, turns ? [] : [6, 4]);
}

/** Between the aft-body and the stream that leaves the lip; the more fuel, the brighter. */
function plume(pen: Pen, view: View, outline: Outline, pose: Pose): void {
  const [lip, shoulder, tail] = [outline.lip, outline.shoulder, outline.tail].map((point) => view.place(point)) as [Point, Point, Point];
  const [low, high] = [view.aft(lip, PLUME_M, -pose.gamma), view.aft(tail, PLUME_M / 3, -pose.gamma)];
  const gradient = pen.context.createLinearGradient(lip[0], 0, low[0], 0);
  const strength = Math.min(1, Math.max(0, pose.phi_effective));
  gradient.addColorStop(0, pen.theme.plume);
  gradient.addColorStop(1, 'transparent');
  pen.context.globalAlpha = 0.15 + 0.85 * strength;
  pen.area([lip, shoulder, tail, high, low], gradient);
  pen.context.globalAlpha = 1;
}

function tanks(pen: Pen, view: View, outline: Outline, pose: Pose, magnified: number): void {
  for (const [i, { floor, roof }] of outline.tanks.entries()) {
    const [bottom, top] = [floor, roof].map((points) => points.map((point) => view.place(point))) as [Point[], Point[]];
    const walls = [...bottom, ...top.toReversed(), bottom[0]!];
    const surface = floor.map(([x, z], k): Point => {
      const level = z + FULL * pose.fuel * (roof[k]![1] - z);
      return view.place([x, level + magnified * pose.slosh[i]!]);
    });
    const { context, theme } = pen;
    pen.area(walls, theme.tank);
    context.save();
    context.clip();
    pen.area([...bottom, ...surface.toReversed()], theme.liquid);
    pen.line(surface, theme.ink, 1);
    context.restore();
    pen.line(walls, theme.ink, 1);
  }
}

function nacelle(pen: Pen, view: View, { nacelle, shoulder }: Outline): void {
  const cowl = nacelle.map((point) => view.place(point));
  const roof = nacelle.map(([x]) => view.place([x, shoulder[1]]));
  pen.area([...cowl, ...roof.toReversed()], pen.theme.tank);
  pen.line(roof, pen.theme.ink, 1.5);
  pen.line(cowl, pen.theme.ink, 3);
}

/** A plate that turns about its middle, trailing edge down. */
function elevator(pen: Pen, view: View, { elevator: { hinge, half } }: Outline, pose: Pose): void {
  const middle = view.place(hinge);
  const angle = -pose.theta - pose.delta_e_effective;
  pen.line([view.aft(middle, -half, angle), view.aft(middle, half, angle)], pen.theme.elevator, 4);
}

function scaleBar(pen: Pen, height: number, scale: number): void {
  const y = height - 14;
  pen.line([[14, y - 4], [14, y], [14 + BAR_M * scale, y], [14 + BAR_M * scale, y - 4]], pen.theme.muted);
  pen.text(`${BAR_M} m`, [14 + (BAR_M * scale) / 2, y - 6], 'center');
}
