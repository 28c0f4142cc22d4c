export { SkinSurface, type SkinSurfaceOptions } from "./skin_surface.js";
