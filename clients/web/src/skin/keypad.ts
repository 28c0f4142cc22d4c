/** A grid of keys whose labels read the right way for the wearer. */
import type { Handedness, Surface } from "../events.js";
import { LayoutError } from "./errors.js";
import { rectangle } from "./polygon.js";
import { readingAxes, toHostFrame, USUAL_READING, type Point, type Reading, type ReadingAxes } from "./reading.js";
import { SLOP_MM, type SkinButton } from "./views.js";

/** Keys closer than this are refused, and the skin that keys may take, (across, along) in mm: `MIN_PITCH_MM`, `ROOM_MM` of the Python package. */
const MIN_PITCH_MM = 12;
const ROOM_MM: Readonly<Record<Surface, Point>> = {
  palm: [70, 83],
  back_of_hand: [70, 83],
  inner_forearm: [50, 200],
  outer_forearm: [50, 200],
};

/**
 * Keys in rows, the first row on top and each row from left to right as the wearer sees them.
 *
 * `xMm`, `yMm` is the centre in the host frame, `pitchMm` the distance of neighbouring keys, `gapMm` the skin between them (2 mm).
 */
export interface KeypadMeasures {
  readonly name: string;
  readonly surface: Surface;
  readonly host: Handedness;
  readonly rows: readonly (readonly string[])[];
  readonly xMm: number;
  readonly yMm: number;
  readonly pitchMm: number;
  readonly gapMm?: number;
  readonly reading?: Reading;
  readonly slopMm?: number;
}

export interface SkinKeypad extends Required<KeypadMeasures> {
  /** The wearer's right and up in the host frame. */
  readonly axes: ReadingAxes;
  /** One button for each key, in reading order, named `<keypad>/<key>`. */
  readonly keys: readonly SkinKey[];
}

export interface SkinKey extends SkinButton {
  readonly key: string;
  readonly centreMm: Point;
}

/** A keypad; throws `LayoutError` when keys repeat, are too small or do not fit the limb. */
export function skinKeypad(measures: KeypadMeasures): SkinKeypad {
  const { name, surface, host, rows, xMm, yMm, pitchMm, gapMm = 2, slopMm = SLOP_MM } = measures;
  const reading = measures.reading ?? USUAL_READING[surface];
  const labels = rows.flat();
  if (!name || labels.length === 0 || labels.some((key) => !key) || new Set(labels).size < labels.length) {
    throw new LayoutError(`keypad "${name}" has the keys ${JSON.stringify(rows)}: give a name and rows of keys, each key once`);
  }
  if (![xMm, yMm, pitchMm, gapMm, slopMm].every(Number.isFinite)) throw new LayoutError(`keypad ${name} has a measure that is no number`);
  if (pitchMm < MIN_PITCH_MM || gapMm < 0 || gapMm > pitchMm / 2) {
    throw new LayoutError(`keypad ${name}: take a pitch of at least ${MIN_PITCH_MM} mm and a gap of at most half of it`);
  }
  const axes = readingAxes(surface, host, reading);
  const sizeMm = pitchMm - gapMm;
  const keys = rows.flatMap((row, r) =>
    row.map((key, c): SkinKey => {
      const [dx, dy] = toHostFrame(axes, [(c - (row.length - 1) / 2) * pitchMm, ((rows.length - 1) / 2 - r) * pitchMm]);
      const centreMm: Point = [xMm + dx, yMm + dy];
      const region = { surface, host, pointsMm: rectangle(...centreMm, sizeMm, sizeMm) };
      return { name: `${name}/${key}`, label: key, key, centreMm, region, slopMm };
    }),
  );
  checkRoom(name, surface, keys, pitchMm, sizeMm);
  return { name, surface, host, rows, xMm, yMm, pitchMm, gapMm, reading, slopMm, axes, keys };
}

function checkRoom(name: string, surface: Surface, keys: readonly SkinKey[], pitchMm: number, sizeMm: number): void {
  const xs = keys.map(({ centreMm }) => centreMm[0]);
  const ys = keys.map(({ centreMm }) => centreMm[1]);
  const across = Math.max(...xs) - Math.min(...xs) + pitchMm;
  const along = Math.max(...ys) - Math.min(...ys) + pitchMm;
  const [roomAcross, roomAlong] = ROOM_MM[surface];
  if (across > roomAcross || along > roomAlong) {
    throw new LayoutError(`keypad ${name} takes ${across} x ${along} mm, the ${surface} has room for ${roomAcross} x ${roomAlong}`);
  }
  const isHand = surface === "palm" || surface === "back_of_hand";
  if (isHand ? Math.min(...ys) < sizeMm / 2 : Math.max(...ys) > -sizeMm / 2) {
    throw new LayoutError(`keypad ${name} lies across the wrist: y_mm is above 0 on the hand and below 0 on the forearm`);
  }
}
