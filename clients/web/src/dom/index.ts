export { attachPointerEvents, type PointerOptions } from "./attach.js";
export { PALM_AREA, placeOn, type PlaceMap, type ScreenPoint, type SkinArea } from "./place.js";
