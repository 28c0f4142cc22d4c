// What the server serves as /egotouch.js: the client for pages without a build step, and for its own pages.

export * from "../../src/dom/index.js";
export * from "../../src/headset/index.js";
export * from "../../src/index.js";
export { FINGERS, HANDS, SURFACES } from "../../src/wire/enums.js";
