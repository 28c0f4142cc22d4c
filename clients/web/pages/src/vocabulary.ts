// Names and colours of what can happen, in one place for log, legend and drawing.

import type { EventType, Finger, Surface } from "../../src/index.js";

export const FINGERS = ["thumb", "index", "middle", "ring", "pinky"] as const satisfies readonly Finger[];

/** Colours of fingers, told apart by people with colour blindness too (Okabe and Ito's palette, lightened for a dark ground). */
export const FINGER_COLOURS: Readonly<Record<Finger, string>> = {
  thumb: "#f0b429", index: "#5ac8fa", middle: "#4ade9c", ring: "#f28cc0", pinky: "#ff8a5c",
};

interface Group {
  readonly label: string;
  readonly colour: string;
  readonly types: readonly EventType[];
}

/** Groups of event types as the log filters them: label, colour, members. */
export const GROUPS: Readonly<Record<string, Group>> = {
  touch: { label: "Touch", colour: "#5ac8fa", types: ["down", "up", "move"] },
  cancel: { label: "Cancel", colour: "#ff6b6b", types: ["cancel"] },
  click: { label: "Click", colour: "#4ade9c", types: ["click", "double_click", "long_click"] },
  drag: { label: "Drag", colour: "#f0b429", types: ["drag_start", "drag", "drag_end", "fling"] },
  force: { label: "Force", colour: "#d3a4ff", types: ["force_enter", "force_change", "force_exit"] },
  hover: { label: "Hover", colour: "#93a4b8", types: ["hover_enter", "hover_move", "hover_exit"] },
};

/** The key of the group that an event type belongs to. */
export const GROUP_OF: Readonly<Partial<Record<EventType, string>>> = Object.fromEntries(
  Object.entries(GROUPS).flatMap(([key, group]) => group.types.map((type) => [type, key])),
);

/** "inner_forearm" as "inner forearm". */
export const words = (name: string): string => name.replaceAll("_", " ");

/** Whole millimetres, without a minus before zero. */
export const whole = (mm: number): string => String(Math.round(mm) + 0);

/** True for the surfaces that are seen together with the palm. */
export const onPalmSide = (surface: Surface): boolean => surface === "palm" || surface === "inner_forearm";

/** The element with this id; pages are written together with their scripts, so it is there. */
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}
