// DOM input on the drawn limb, turned into played fingers.

import type { Controls } from "./controls.js";
import type { LimbView } from "./limb_view.js";
import { penOf, type PlayedFingers } from "./played_fingers.js";
import { FINGERS } from "./vocabulary.js";

const KEYBOARD = "keys";
const STEP_MM = 1;
const ARROWS: Readonly<Record<string, readonly [number, number]>> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** Play `fingers` with whatever input device there is. */
export function playWith(view: LimbView, fingers: PlayedFingers, controls: Controls): void {
  const canvas = view.canvas;
  const pointerOf = (event: PointerEvent) => ({ id: event.pointerId, x: event.offsetX, y: event.offsetY, pen: penOf(event, view) });
  const follow = (event: PointerEvent) => fingers.move(pointerOf(event), { down: event.buttons !== 0, now: performance.now(), shift: event.shiftKey });
  canvas.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "touch") canvas.setPointerCapture(event.pointerId); // a touch is captured by itself
    follow(event);
  });
  canvas.addEventListener("pointermove", follow);
  canvas.addEventListener("pointerup", (event) => {
    follow(event);
    if (event.pointerType === "touch") fingers.leave(event.pointerId, performance.now());
  });
  canvas.addEventListener("pointerleave", (event) => fingers.leave(event.pointerId, performance.now()));
  canvas.addEventListener("pointercancel", () => fingers.vanish());
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    controls.nudge(fingers.pressing ? "force" : "hover", -Math.sign(event.deltaY));
  }, { passive: false });
  addEventListener("blur", () => fingers.vanish());
  addEventListener("pagehide", () => fingers.vanish());
  document.addEventListener("visibilitychange", () => document.visibilityState === "hidden" && fingers.vanish());
  playWithKeys(view, fingers, controls);
}

function playWithKeys(view: LimbView, fingers: PlayedFingers, controls: Controls): void {
  const canvas = view.canvas;
  let at: [number, number] | null = null;
  let down = false;
  const play = () => at && fingers.move({ id: KEYBOARD, x: at[0], y: at[1], pen: null }, { down, now: performance.now() });
  canvas.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (arrow || event.key === " ") {
      event.preventDefault();
      at ??= view.toScreen(0, 45);
      if (arrow) at = [at[0] + arrow[0] * STEP_MM * view.scale, at[1] + arrow[1] * STEP_MM * view.scale];
      else down = true;
      play();
    } else if (event.key >= "1" && event.key <= "5") {
      controls.finger = FINGERS[Number(event.key) - 1]!;
    } else if (event.key.toLowerCase() === "h") {
      controls.toggleHoverOnly();
    } else if (event.key === "Escape") {
      at = null;
      down = false;
      fingers.vanish();
    }
  });
  canvas.addEventListener("keyup", (event) => {
    if (event.key !== " " || !at) return;
    down = false;
    play();
  });
  canvas.addEventListener("blur", () => {
    at = null;
    down = false;
    fingers.leave(KEYBOARD, performance.now());
  });
}
