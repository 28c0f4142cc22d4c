/** The limb with its keys and fingers as SVG, turned the way its wearer sees it; its units are millimetres. */
import type { Surface } from "../../src/events.js";
import { toHostFrame, toView, type FingerLook, type Point, type SkinKeypad } from "../../src/skin/index.js";
import { BACK_LINES_MM, NAILS_MM, OUTLINE_MM, PALM_LINES_MM, smoothPathData } from "../../pages/src/hand_outline.js";
import type { KeypadModel } from "./keypad_model.js";
import { LETTERS } from "./words.js";

const SVG = "http://www.w3.org/2000/svg";
/** The hardest press that the model tells apart, in newtons. */
const FULL_FORCE_N = 3.5;
const KEY_CORNER_MM = 3.6;
/** The part of the limb that is shown, in the host frame: [least x, greatest x, least y, greatest y]. */
const SHOWN_MM: Readonly<Record<Surface, readonly [number, number, number, number]>> = {
  palm: [-58, 92, -54, 182],
  back_of_hand: [-58, 92, -54, 182],
  inner_forearm: [-52, 58, -178, 34],
  outer_forearm: [-52, 58, -178, 34],
};
/** Over this length the limb fades where the picture ends. */
const FADE_MM = 34;

interface KeyElements {
  readonly key: SkinKeypad["keys"][number];
  readonly group: SVGElement;
}

export class LimbPicture {
  readonly svg: SVGSVGElement;
  #keypad: SkinKeypad | null = null;
  #keys: readonly KeyElements[] = [];
  #fingers: SVGElement = node("g", { class: "fingers" });
  #outline: SVGPathElement | null = null;
  #serial = 0;

  constructor(svg: SVGSVGElement) {
    this.svg = svg;
  }

  /** Show the model as it is now. */
  draw(model: KeypadModel): void {
    if (model.keypad !== this.#keypad) this.#lay(model.keypad);
    for (const { key, group } of this.#keys) {
      const { isHovered, isPressed, forceN } = model.look(key);
      group.classList.toggle("hovered", isHovered);
      group.classList.toggle("pressed", isPressed);
      group.style.setProperty("--force", String(Math.min(forceN / FULL_FORCE_N, 1)));
    }
    this.#flash(model);
    this.#fingers.replaceChildren(...model.fingers.map((finger) => this.#finger(finger)));
  }

  /** Where a point of the window is on the limb, and whether that is skin. */
  placeAt(clientX: number, clientY: number): { place: Point; isSkin: boolean } {
    const matrix = this.svg.getScreenCTM()?.inverse();
    if (!matrix || !this.#keypad || !this.#outline) return { place: [0, 0], isSkin: false };
    const point = new DOMPoint(clientX, clientY).matrixTransform(matrix);
    return { place: toHostFrame(this.#keypad.axes, [point.x, -point.y]), isSkin: this.#outline.isPointInFill(point) };
  }

  /** Where a place of the limb is in the window. */
  toWindow(place: Point): Point {
    const [x, y] = this.#place(place);
    const point = new DOMPoint(x, y).matrixTransform(this.svg.getScreenCTM() ?? new DOMMatrix());
    return [point.x, point.y];
  }

  /** Host frame to the picture: as the wearer sees it, y down. */
  #place(place: Point): Point {
    if (!this.#keypad) return [0, 0];
    const [right, up] = toView(this.#keypad.axes, place);
    return [right, -up];
  }

  #lay(keypad: SkinKeypad): void {
    this.#keypad = keypad;
    const [x0, x1, y0, y1] = SHOWN_MM[keypad.surface];
    const corners = [this.#place([x0, y0]), this.#place([x1, y1])] as const;
    const left = Math.min(corners[0][0], corners[1][0]);
    const top = Math.min(corners[0][1], corners[1][1]);
    this.svg.setAttribute("viewBox", `${left} ${top} ${Math.abs(corners[0][0] - corners[1][0])} ${Math.abs(corners[0][1] - corners[1][1])}`);
    this.svg.dataset["reading"] = keypad.reading;
    const place = (x: number, y: number): Point => this.#place([x, y]);
    const isBack = keypad.surface === "back_of_hand" || keypad.surface === "outer_forearm";
    this.#outline = node("path", { class: "skin", fill: "url(#skin-fill)", d: smoothPathData(OUTLINE_MM, place, true) });
    const lines = (isBack ? BACK_LINES_MM : PALM_LINES_MM).map((line) => node("path", { class: "line", d: smoothPathData(line, place, false) }));
    const nails = isBack ? NAILS_MM.map((nail) => node("path", { class: "nail", d: smoothPathData(nail, place, true) })) : [];
    this.#keys = keypad.keys.map((key) => ({ key, group: keyElement(key.key, this.#place(key.centreMm), keypad.pitchMm - keypad.gapMm) }));
    this.#fingers = node("g", { class: "fingers" });
    const limb = node("g", { class: "limb", mask: "url(#fade)" }, this.#outline, ...lines, ...nails);
    const keys = node("g", { class: "keys" }, ...this.#keys.map(({ group }) => group));
    const far = OUTLINE_MM.some(([, y]) => y > y1) ? y1 : y1 + FADE_MM;
    const fading = fade(this.#place([0, y0]), this.#place([0, y0 + FADE_MM]), this.#place([0, far]));
    const defs = this.svg.querySelector("defs");
    this.svg.replaceChildren(...(defs ? [defs] : []), ...fading, limb, keys, this.#fingers);
  }

  #flash({ note, keypad }: KeypadModel): void {
    if (note.serial === this.#serial) return;
    this.#serial = note.serial;
    const key = this.#keys.find((candidate) => candidate.key.key === (note.kind === "plus" ? "0" : note.key));
    if (!key || note.kind === "erased") return;
    const size = keypad.pitchMm - keypad.gapMm;
    const ring = node("rect", { class: `flash ${note.kind}`, x: -size / 2, y: -size / 2, width: size, height: size, rx: KEY_CORNER_MM });
    ring.addEventListener("animationend", () => ring.remove());
    key.group.append(ring);
  }

  #finger({ xMm, yMm, pitchRad, yawRad, forceN, isTouching }: FingerLook): SVGElement {
    const [x, y] = this.#place([xMm, yMm]);
    const lengthMm = 20 + 46 * Math.cos(pitchRad);
    const [endX, endY] = this.#place([xMm - Math.sin(yawRad) * lengthMm, yMm - Math.cos(yawRad) * lengthMm]);
    return node(
      "g",
      { class: isTouching ? "finger touching" : "finger" },
      node("line", { class: "shaft", x1: x, y1: y, x2: endX, y2: endY }),
      node("circle", { class: "ring", cx: x, cy: y, r: isTouching ? 6.2 + 2.6 * Math.min(forceN / FULL_FORCE_N, 1) : 5.6 }),
    );
  }
}

/** A mask that fades the limb in from `from` to `full`, and out by the same way before `end`. */
function fade(from: Point, full: Point, end: Point): SVGElement[] {
  const stop = (offset: number, colour: string): SVGElement => node("stop", { offset, "stop-color": colour });
  const share = (full[0] - from[0] + full[1] - from[1]) / (end[0] - from[0] + end[1] - from[1]);
  const gradient = node(
    "linearGradient",
    { id: "fade-colours", gradientUnits: "userSpaceOnUse", x1: from[0], y1: from[1], x2: end[0], y2: end[1] },
    ...[stop(0, "#000"), stop(share, "#fff"), stop(1 - share, "#fff"), stop(1, "#000")],
  );
  const whole = node("rect", { x: -500, y: -500, width: 1000, height: 1000, fill: "url(#fade-colours)" });
  return [gradient, node("mask", { id: "fade", maskUnits: "userSpaceOnUse", x: -500, y: -500, width: 1000, height: 1000 }, whole)];
}

function keyElement(key: string, [x, y]: Point, size: number): SVGElement {
  const rect = (className: string): SVGElement =>
    node("rect", { class: className, x: -size / 2, y: -size / 2, width: size, height: size, rx: KEY_CORNER_MM });
  const letters = LETTERS[key];
  const label = node("text", { class: "label", y: letters ? -1.1 : 0.4 });
  label.textContent = key === "*" ? "∗" : key;
  const cap = node("g", { class: "cap" }, rect("face"), rect("ink"), label);
  if (letters) {
    const sub = node("text", { class: "letters", y: 4.1 });
    sub.textContent = letters;
    cap.append(sub);
  }
  return node("g", { class: "key", transform: `translate(${x} ${y})`, "data-key": key }, rect("well"), cap);
}

function node<Name extends keyof SVGElementTagNameMap>(
  name: Name,
  attributes: Readonly<Record<string, string | number>>,
  ...children: SVGElement[]
): SVGElementTagNameMap[Name] {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}
