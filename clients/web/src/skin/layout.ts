/** Layouts from plain data, in the format of the Python package (`python -m pydoc egotouch_sdk.skin.loading`): millimetres, snake_case. */
import type { Handedness, Surface } from "../events.js";
import { LayoutError } from "./errors.js";
import { skinKeypad, type SkinKeypad } from "./keypad.js";
import { circle, rectangle, rounded, signedArea } from "./polygon.js";
import type { Point, Reading } from "./reading.js";
import { SLOP_MM, type Region, type SkinButton } from "./views.js";

/** Keypads and buttons, the later ones on top of the earlier ones. */
export interface SkinLayout {
  readonly keypads: readonly SkinKeypad[];
  /** Every button from bottom to top, those of the keypads among them. */
  readonly views: readonly SkinButton[];
}

type Table = Readonly<Record<string, unknown>>;

const SURFACES: readonly Surface[] = ["palm", "back_of_hand", "inner_forearm", "outer_forearm"];
const HANDS: readonly Handedness[] = ["left", "right"];
const READINGS: readonly Reading[] = ["across", "along"];
const SHAPES = ["points_mm", "rectangle", "circle", "rounded"] as const;

/** The layout that plain data describe; throws `LayoutError` that names the view and the key that is wrong. */
export function layoutFromData(data: unknown): SkinLayout {
  const items = table(data, "the layout", ["views"])["views"];
  if (!Array.isArray(items) || items.length === 0) throw new LayoutError('the layout has no views: give a list "views" of tables');
  const read = items.map((item, i) => readItem(item, i));
  const keypads = read.flatMap((item) => ("keys" in item ? [item] : []));
  const views = read.flatMap((item): readonly SkinButton[] => ("keys" in item ? item.keys : [item]));
  const names = [...views, ...keypads].map(({ name }) => name);
  const twice = names.find((name, i) => names.indexOf(name) < i);
  if (twice !== undefined) throw new LayoutError(`the name ${twice} is used twice in a layout: give each view a name of its own`);
  return { keypads, views };
}

function readItem(item: unknown, index: number): SkinKeypad | SkinButton {
  const kind = isTable(item) ? item["type"] : undefined;
  const where = isTable(item) && typeof item["name"] === "string" && item["name"] ? `view ${item["name"]}` : `view ${index + 1}`;
  if (kind === "keypad") return readKeypad(item, where);
  if (kind === "button" || kind === "view") return readButton(item, where);
  throw new LayoutError(`${where} has type ${JSON.stringify(kind)}: set it to keypad, button or view`);
}

function readKeypad(item: unknown, where: string): SkinKeypad {
  const required = ["type", "name", "surface", "host", "rows", "x_mm", "y_mm", "pitch_mm"];
  const t = table(item, where, required, ["gap_mm", "reading", "slop_mm"]);
  const gapMm = optionalNumber(t, "gap_mm", where);
  const slopMm = optionalNumber(t, "slop_mm", where);
  return skinKeypad({
    name: text(t, "name", where),
    surface: member(t["surface"], "surface", SURFACES, where),
    host: member(t["host"], "host", HANDS, where),
    rows: readRows(t["rows"], where),
    xMm: number(t, "x_mm", where),
    yMm: number(t, "y_mm", where),
    pitchMm: number(t, "pitch_mm", where),
    ...(t["reading"] == null ? {} : { reading: member(t["reading"], "reading", READINGS, where) }),
    ...(gapMm === undefined ? {} : { gapMm }),
    ...(slopMm === undefined ? {} : { slopMm }),
  });
}

function readButton(item: unknown, where: string): SkinButton {
  const t = table(item, where, ["type", "name", "region"], ["label", "slop_mm"]);
  const name = text(t, "name", where);
  return {
    name,
    label: t["label"] === undefined || t["label"] === "" ? name : text(t, "label", where),
    region: readRegion(t["region"], `${where}: region`),
    slopMm: optionalNumber(t, "slop_mm", where) ?? SLOP_MM,
  };
}

function readRegion(value: unknown, where: string): Region {
  const t = table(value, where, ["surface"], ["host", ...SHAPES]);
  const shapes = SHAPES.filter((shape) => t[shape] !== undefined);
  const [shape] = shapes;
  if (shapes.length !== 1 || !shape) throw new LayoutError(`${where} has ${shapes.length} shapes: give one of ${SHAPES.join(", ")}`);
  const pointsMm = shape === "points_mm" ? readPoints(t[shape], where) : readShape(shape, t[shape], `${where}.${shape}`);
  if (Math.abs(signedArea(pointsMm)) < 1) throw new LayoutError(`${where} is empty: its corners must enclose at least 1 mm² of skin`);
  return {
    surface: member(t["surface"], "surface", SURFACES, where),
    host: t["host"] == null ? null : member(t["host"], "host", HANDS, where),
    pointsMm,
  };
}

function readShape(shape: "rectangle" | "circle" | "rounded", value: unknown, where: string): readonly Point[] {
  const sizes = { rectangle: ["width_mm", "height_mm"], circle: ["radius_mm"], rounded: ["width_mm", "height_mm", "corner_mm"] }[shape];
  const t = table(value, where, ["x_mm", "y_mm", ...sizes]);
  const at = (key: string): number => number(t, key, where);
  for (const key of sizes) if (at(key) <= 0) throw new LayoutError(`${where}: ${key} is ${at(key)}: give millimetres above 0`);
  if (shape === "circle") return circle(at("x_mm"), at("y_mm"), at("radius_mm"));
  const [x, y, width, height] = [at("x_mm"), at("y_mm"), at("width_mm"), at("height_mm")];
  if (shape === "rectangle") return rectangle(x, y, width, height);
  if (at("corner_mm") > Math.min(width, height) / 2) throw new LayoutError(`${where}: corner_mm is more than half of the shorter side`);
  return rounded(x, y, width, height, at("corner_mm"));
}

function readPoints(value: unknown, where: string): readonly Point[] {
  const isPoint = (point: unknown): point is Point => Array.isArray(point) && point.length === 2 && point.every(Number.isFinite);
  if (!Array.isArray(value) || value.length < 3 || value.length > 256 || !value.every(isPoint)) {
    throw new LayoutError(`${where}: points_mm is no list of 3 to 256 places [x_mm, y_mm]`);
  }
  return value;
}

function readRows(value: unknown, where: string): readonly (readonly string[])[] {
  const isRow = (row: unknown): row is string | string[] =>
    typeof row === "string" || (Array.isArray(row) && row.every((key) => typeof key === "string"));
  if (!Array.isArray(value) || !value.every(isRow)) throw new LayoutError(`${where}: rows is no list like ["123"] or [["del", "ok"]]`);
  return value.map((row) => [...row]);
}

function table(value: unknown, where: string, required: readonly string[], optional: readonly string[] = []): Table {
  if (!isTable(value)) throw new LayoutError(`${where} is ${JSON.stringify(value)}: give a table with ${required.join(", ")}`);
  const known = [...required, ...optional];
  const unknown = Object.keys(value).find((key) => !known.includes(key));
  if (unknown !== undefined) throw new LayoutError(`${where}: there is no key ${unknown}; there are: ${known.join(", ")}`);
  const missing = required.find((key) => value[key] === undefined);
  if (missing !== undefined) throw new LayoutError(`${where}: ${missing} is missing; keys are: ${known.join(", ")}`);
  return value;
}

const isTable = (value: unknown): value is Table => typeof value === "object" && value !== null && !Array.isArray(value);

function number(t: Table, key: string, where: string): number {
  const value = t[key];
  if (typeof value !== "number" || !(Math.abs(value) < 1e9)) throw new LayoutError(`${where}: ${key} is ${JSON.stringify(value)}: give a number`);
  return value;
}

const optionalNumber = (t: Table, key: string, where: string): number | undefined => (t[key] === undefined ? undefined : number(t, key, where));

function text(t: Table, key: string, where: string): string {
  const value = t[key];
  if (typeof value !== "string" || !value) throw new LayoutError(`${where}: ${key} is ${JSON.stringify(value)}: give text in quotes`);
  return value;
}

function member<T extends string>(value: unknown, key: string, known: readonly T[], where: string): T {
  const found = known.find((name) => name === value);
  if (found === undefined) throw new LayoutError(`${where}: ${key} is ${JSON.stringify(value)}: give one of ${known.join(", ")}`);
  return found;
}
