// A value over the last seconds, one line per series, on a canvas.

/** `windowMs` is the span shown, `top` the least upper end of the axis, `unit` its unit; `dots` draws points instead of lines. */
export interface PlotOptions {
  readonly top: number;
  readonly unit: string;
  readonly windowMs?: number;
  readonly dots?: boolean;
}

interface Series {
  readonly colour: string;
  readonly points: { readonly at: number; readonly value: number | null }[];
}

type Key = string | number;

export class Plot {
  readonly #canvas: HTMLCanvasElement;
  readonly #options: Required<PlotOptions>;
  readonly #series = new Map<Key, Series>();
  #level: { readonly value: number; readonly name: string } | null = null;
  #width = 0; // of the canvas, in CSS pixels
  #height = 0;

  constructor(canvas: HTMLCanvasElement, options: PlotOptions) {
    this.#canvas = canvas;
    this.#options = { windowMs: 8000, dots: false, ...options };
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
  }

  /** A dashed line at a value, with its name; null removes it. */
  set level(level: { readonly value: number; readonly name: string } | null) {
    this.#level = level;
  }

  /** Add a value; null breaks the line. */
  add(key: Key, colour: string, at: number, value: number | null): void {
    const series: Series = this.#series.get(key) ?? { colour, points: [] };
    series.points.push({ at, value });
    this.#series.set(key, series);
    this.#expire(series, at);
  }

  /** Forget all values. */
  clear(): void {
    this.#series.clear();
  }

  /** A part of one series' values, for example 0.95 for the 95th percentile; null without values. */
  percentile(key: Key, share: number): number | null {
    const values = (this.#series.get(key)?.points ?? []).flatMap(({ value }) => (value === null ? [] : [value])).sort((a, b) => a - b);
    return values[Math.min(values.length - 1, Math.floor(share * values.length))] ?? null;
  }

  draw(now: number): void {
    const { windowMs, top, unit } = this.#options;
    for (const [key, series] of this.#series) {
      this.#expire(series, now);
      if (!series.points.length) this.#series.delete(key);
    }
    const context = this.#canvas.getContext("2d")!;
    const [width, height, left, bottom] = [this.#width, this.#height, 38, 18] as const;
    const highest = [...this.#series.values()].flatMap(({ points }) => points).reduce((most, { value }) => Math.max(most, value ?? 0), top);
    const x = (at: number) => width - ((now - at) / windowMs) * (width - left);
    const y = (value: number) => 6 + (1 - value / highest) * (height - bottom - 6);
    context.clearRect(0, 0, width, height);
    this.#axes(context, { width, height, left, highest, y, unit, windowMs });
    context.save();
    context.beginPath();
    context.rect(left, 0, width - left, height - bottom + 2);
    context.clip();
    for (const series of this.#series.values()) this.#line(context, series, x, y);
    context.restore();
  }

  #expire({ points }: Series, now: number): void {
    while (points[0] && now - points[0].at > this.#options.windowMs) points.shift();
  }

  #line(context: CanvasRenderingContext2D, { colour, points }: Series, x: (at: number) => number, y: (value: number) => number): void {
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = 2;
    context.lineJoin = "round";
    context.beginPath();
    let pen = false;
    for (const { at, value } of points) {
      if (value === null) pen = false;
      else if (this.#options.dots) context.fillRect(x(at) - 1.25, y(value) - 1.25, 2.5, 2.5);
      else if (pen) context.lineTo(x(at), y(value));
      else context.moveTo(x(at), y(value));
      pen = value !== null;
    }
    context.stroke();
  }

  #axes(context: CanvasRenderingContext2D, { width, height, left, highest, y, unit, windowMs }: Axes): void {
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "middle";
    context.textAlign = "right";
    context.fillStyle = "#93a4b8";
    context.strokeStyle = "rgb(147 164 184 / 0.18)";
    context.lineWidth = 1;
    const step = niceStep(highest / 3);
    for (let value = 0; value <= highest; value += step) {
      context.beginPath();
      context.moveTo(left, y(value));
      context.lineTo(width, y(value));
      context.stroke();
      context.fillText(`${+value.toFixed(2)}`, left - 6, y(value));
    }
    context.textBaseline = "alphabetic";
    context.textAlign = "left";
    context.fillText(unit, 2, height - 4);
    context.fillText(`${windowMs / 1000} s ago`, left, height - 4);
    context.textAlign = "right";
    context.fillText("now", width - 2, height - 4);
    if (!this.#level || this.#level.value > highest) return;
    context.setLineDash([4, 4]);
    context.strokeStyle = "rgb(211 164 255 / 0.7)";
    context.beginPath();
    context.moveTo(left, y(this.#level.value));
    context.lineTo(width, y(this.#level.value));
    context.stroke();
    context.setLineDash([]);
    context.fillStyle = "#d3a4ff";
    context.textAlign = "left";
    context.fillText(this.#level.name, left + 4, y(this.#level.value) - 4);
  }

  #resize(): void {
    const ratio = Math.min(devicePixelRatio || 1, 2);
    this.#width = this.#canvas.clientWidth;
    this.#height = this.#canvas.clientHeight;
    this.#canvas.width = Math.round(this.#width * ratio);
    this.#canvas.height = Math.round(this.#height * ratio);
    this.#canvas.getContext("2d")!.setTransform(ratio, 0, 0, ratio, 0, 0);
  }
}

interface Axes {
  readonly width: number;
  readonly height: number;
  readonly left: number;
  readonly highest: number;
  readonly unit: string;
  readonly windowMs: number;
  y(value: number): number;
}

/** The smallest of 1, 2, 5 times a power of ten that is not below `value`. */
function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= value * 0.999) ?? value;
}
