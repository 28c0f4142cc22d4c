import { EgoTouchError } from "../errors.js";
import type { Finger, Handedness, Surface, TouchEvent } from "../events.js";
import { FINGERS, HANDS, SURFACES, type EnumTable } from "../wire/enums.js";

type OneOrMore<T> = T | readonly T[];

/** Which events a listener wants; what is left out does not matter. `hand` is the touching one. */
export interface EventFilter {
  readonly finger?: OneOrMore<Finger>;
  readonly hand?: OneOrMore<Handedness>;
  readonly surface?: OneOrMore<Surface>;
}

/** A filter as a function; throws for a name that does not exist and for an empty list, which would hear nothing. */
export function accepting({ finger, hand, surface }: EventFilter): (event: TouchEvent) => boolean {
  const fingers = names("finger", finger, FINGERS);
  const hands = names("hand", hand, HANDS);
  const surfaces = names("surface", surface, SURFACES);
  return (event) => (fingers?.has(event.finger) ?? true) && (hands?.has(event.hand) ?? true) && (surfaces?.has(event.surface) ?? true);
}

function names<T extends string>(field: string, given: OneOrMore<T> | undefined, table: EnumTable<T>): ReadonlySet<T> | null {
  if (given === undefined) return null;
  const wanted = typeof given === "string" ? [given] : given;
  for (const name of wanted) {
    if (!table.names.includes(name)) throw new EgoTouchError("config", `there is no ${field} "${String(name)}"`, `Give one of ${table.names.join(", ")}`);
  }
  if (!wanted.length) throw new EgoTouchError("config", `the list of ${field} is empty`, `Leave ${field} out to hear all`);
  return new Set(wanted);
}
