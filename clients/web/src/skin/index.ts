export { LayoutError } from "./errors.js";
export type { CallName } from "./fingers.js";
export { SkinViewGroup, type FingerLook, type KeyListener, type KeyPress, type ViewListener, type ViewLook } from "./group.js";
export { skinKeypad, type KeypadMeasures, type SkinKey, type SkinKeypad } from "./keypad.js";
export { layoutFromData, type SkinLayout } from "./layout.js";
export { readingAxes, toHostFrame, toView, USUAL_READING, type Point, type Reading, type ReadingAxes } from "./reading.js";
export { SLOP_MM, type Region, type SkinButton } from "./views.js";
