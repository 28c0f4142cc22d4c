import type { Surface } from "./events.js";

/** True for the palm and the inner forearm, which continue one another beyond the wrist. */
export const isInnerSide = (surface: Surface): boolean => surface === "palm" || surface === "inner_forearm";
