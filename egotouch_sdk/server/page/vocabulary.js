// Names and colours of what can happen, in one place for log, legend and drawing.

export const FINGERS = ["THUMB", "INDEX", "MIDDLE", "RING", "PINKY"];

/** Colours of fingers, told apart by people with colour blindness too (Okabe and Ito's palette, lightened for a dark ground). */
export const FINGER_COLOURS = { THUMB: "#f0b429", INDEX: "#5ac8fa", MIDDLE: "#4ade9c", RING: "#f28cc0", PINKY: "#ff8a5c" };

/** Groups of event types as the log filters them: label, colour, members. */
export const GROUPS = {
  touch: { label: "Touch", colour: "#5ac8fa", types: ["DOWN", "UP", "MOVE"] },
  cancel: { label: "Cancel", colour: "#ff6b6b", types: ["CANCEL"] },
  click: { label: "Click", colour: "#4ade9c", types: ["CLICK", "DOUBLE_CLICK", "LONG_CLICK"] },
  drag: { label: "Drag", colour: "#f0b429", types: ["DRAG_START", "DRAG", "DRAG_END", "FLING"] },
  force: { label: "Force", colour: "#d3a4ff", types: ["FORCE_ENTER", "FORCE_CHANGE", "FORCE_EXIT"] },
  hover: { label: "Hover", colour: "#93a4b8", types: ["HOVER_ENTER", "HOVER_MOVE", "HOVER_EXIT"] },
};

/** The key of the group that an event type belongs to. */
export const GROUP_OF = Object.fromEntries(Object.entries(GROUPS).flatMap(([key, group]) => group.types.map((type) => [type, key])));

/** "INNER_FOREARM" as "inner forearm". */
export const words = (name) => name.toLowerCase().replaceAll("_", " ");

/** The hand whose limb is touched. */
export const hostOf = (event) => (event.hand === "RIGHT" ? "LEFT" : "RIGHT");

/** True for the surfaces that are seen together with the palm. */
export const onPalmSide = (surface) => surface === "PALM" || surface === "INNER_FOREARM";
