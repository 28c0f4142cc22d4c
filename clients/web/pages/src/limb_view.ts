// One side of a host limb on a canvas: the drawn skin, and above it whatever marks are painted each frame.

import type { Handedness, Surface } from "../../src/index.js";
import { BACK_LINES_MM, BOUNDS_MM, NAILS_MM, OUTLINE_MM, PALM_LINES_MM, smoothPath } from "./hand_outline.js";

const SKIN = { top: "#33475c", bottom: "#17212c", edge: "#7f98b3", line: "#587089", nail: "#48617a" };
const SCALE_BAR_MM = 20;

export type Side = "palm" | "back";
/** Draws the marks above the skin, in CSS pixels. */
export type Paint = (view: LimbView, context: CanvasRenderingContext2D) => void;

export class LimbView {
  side: Side;
  readonly #canvas: HTMLCanvasElement;
  readonly #paint: Paint;
  #skin: HTMLCanvasElement | null = null;
  #outline = new Path2D();
  #scale = 1; // CSS pixels per millimetre
  #ratio = 1;
  #width = 0; // of the canvas, in CSS pixels
  #height = 0;
  #host: Handedness = "left";

  constructor(canvas: HTMLCanvasElement, side: Side, paint: Paint) {
    this.#canvas = canvas;
    this.side = side;
    this.#paint = paint;
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  /** The host's side: seen from the palm, a left hand has its thumb on the left. */
  get host(): Handedness {
    return this.#host;
  }

  set host(host: Handedness) {
    if (host === this.#host) return;
    this.#host = host;
    this.refresh();
  }

  get canvas(): HTMLCanvasElement {
    return this.#canvas;
  }

  /** CSS pixels per millimetre. */
  get scale(): number {
    return this.#scale;
  }

  /** 1 when the thumb side is on the right of the picture, -1 when it is on the left. */
  get thumbwards(): 1 | -1 {
    return (this.#host === "left") === (this.side === "palm") ? -1 : 1;
  }

  /** Host-frame millimetres to CSS pixels of the canvas. */
  toScreen(xMm: number, yMm: number): [number, number] {
    const { left, right, top } = BOUNDS_MM;
    return [this.#width / 2 + this.thumbwards * (xMm - (left + right) / 2) * this.#scale, (top - yMm) * this.#scale + this.#marginTop];
  }

  /** CSS pixels of the canvas to host-frame millimetres. */
  toMm(x: number, y: number): [number, number] {
    const { left, right, top } = BOUNDS_MM;
    const xMm = (x - this.#width / 2) / (this.thumbwards * this.#scale) + (left + right) / 2;
    return [xMm, top - (y - this.#marginTop) / this.#scale];
  }

  /** The surface at a height along the limb. */
  surfaceAt(yMm: number): Surface {
    if (this.side === "palm") return yMm < 0 ? "inner_forearm" : "palm";
    return yMm < 0 ? "outer_forearm" : "back_of_hand";
  }

  /** True where a point of the canvas (CSS pixels) is on the limb. */
  isOnSkin(x: number, y: number): boolean {
    const context = this.#canvas.getContext("2d")!;
    context.setTransform(1, 0, 0, 1, 0, 0);
    return context.isPointInPath(this.#outline, x, y);
  }

  /** Draw the skin anew, as after another side was chosen. */
  refresh(): void {
    this.#skin = null;
    this.draw();
  }

  draw(): void {
    const { width, height } = this.#canvas;
    if (!width || !height) return;
    const context = this.#canvas.getContext("2d")!;
    this.#skin ??= this.#drawSkin();
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.drawImage(this.#skin, 0, 0);
    context.scale(this.#ratio, this.#ratio);
    this.#paint(this, context);
  }

  get #marginTop(): number {
    return (this.#height - (BOUNDS_MM.top - BOUNDS_MM.bottom) * this.#scale) / 2;
  }

  #resize(): void {
    this.#width = this.#canvas.clientWidth;
    this.#height = this.#canvas.clientHeight;
    this.#ratio = Math.min(devicePixelRatio || 1, 2);
    this.#canvas.width = Math.round(this.#width * this.#ratio);
    this.#canvas.height = Math.round(this.#height * this.#ratio);
    const { left, right, top, bottom } = BOUNDS_MM;
    this.#scale = Math.min(this.#width / (right - left), this.#height / (top - bottom));
    this.refresh();
  }

  #drawSkin(): HTMLCanvasElement {
    const picture = document.createElement("canvas");
    picture.width = this.#canvas.width;
    picture.height = this.#canvas.height;
    const context = picture.getContext("2d")!;
    context.scale(this.#ratio, this.#ratio);
    const place = (x: number, y: number) => this.toScreen(x, y);
    const outline = (this.#outline = smoothPath(OUTLINE_MM, place, true));
    this.#fillSkin(context, outline);
    context.save();
    context.clip(outline);
    context.lineCap = "round";
    context.strokeStyle = SKIN.line;
    context.lineWidth = Math.max(1, 0.8 * this.#scale);
    for (const line of this.side === "palm" ? PALM_LINES_MM : BACK_LINES_MM) context.stroke(smoothPath(line, place, false));
    if (this.side === "back") {
      context.fillStyle = SKIN.nail;
      for (const nail of NAILS_MM) context.fill(smoothPath(nail, place, true));
    }
    context.restore();
    this.#fadeElbow(context);
    this.#drawAxes(context);
    return picture;
  }

  #fillSkin(context: CanvasRenderingContext2D, outline: Path2D): void {
    const [, top] = this.toScreen(0, BOUNDS_MM.top);
    const [, bottom] = this.toScreen(0, BOUNDS_MM.bottom);
    const fill = context.createLinearGradient(0, top, 0, bottom);
    fill.addColorStop(0, SKIN.top);
    fill.addColorStop(1, SKIN.bottom);
    context.fillStyle = fill;
    context.fill(outline);
    const [x, y] = this.toScreen(2, 40);
    const light = context.createRadialGradient(x, y, 4 * this.#scale, x, y, 75 * this.#scale);
    light.addColorStop(0, "rgb(160 190 220 / 0.16)");
    light.addColorStop(1, "rgb(160 190 220 / 0)");
    context.fillStyle = light;
    context.fill(outline);
    context.strokeStyle = SKIN.edge;
    context.lineWidth = Math.max(1.2, 0.9 * this.#scale);
    context.lineJoin = "round";
    context.stroke(outline);
  }

  #fadeElbow(context: CanvasRenderingContext2D): void {
    const [, from] = this.toScreen(0, BOUNDS_MM.bottom + 70);
    const [, to] = this.toScreen(0, BOUNDS_MM.bottom + 2);
    const fade = context.createLinearGradient(0, from, 0, to);
    fade.addColorStop(0, "rgb(0 0 0 / 0)");
    fade.addColorStop(1, "rgb(0 0 0 / 1)");
    context.globalCompositeOperation = "destination-out";
    context.fillStyle = fade;
    context.fillRect(0, from, this.#width, this.#height);
    context.globalCompositeOperation = "source-over";
  }

  /** The wrist's origin with the directions of +x and +y, and a bar for scale. */
  #drawAxes(context: CanvasRenderingContext2D): void {
    const [x, y] = this.toScreen(0, 0);
    const [xEnd] = this.toScreen(12, 0);
    const [, yEnd] = this.toScreen(0, 12);
    context.strokeStyle = context.fillStyle = "rgb(200 216 232 / 0.55)";
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(xEnd, y);
    context.lineTo(x, y);
    context.lineTo(x, yEnd);
    context.stroke();
    context.font = `${Math.max(10, 5 * this.#scale)}px system-ui, sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText("x", xEnd + 5 * this.thumbwards * this.#scale, y);
    context.fillText("y", x, yEnd - 5 * this.#scale);
    const bar = SCALE_BAR_MM * this.#scale;
    const [edge, low] = [this.#width - 10, this.#height - 10];
    context.fillRect(edge - bar, low, bar, 2);
    context.textAlign = "right";
    context.textBaseline = "bottom";
    context.fillText(`${SCALE_BAR_MM} mm`, edge, low - 3);
  }
}
