/** Connects the mouse on the picture to the simulator, as long as that is the server's source. */
import type { EgoTouchClient } from "../../src/index.js";
import type { KeypadModel } from "./keypad_model.js";
import type { LimbPicture } from "./limb_picture.js";
import { PlayedFinger } from "./played_finger.js";

/** Messages are due at most this often. */
const EVERY_MS = 16;

export function connectMouse(picture: LimbPicture, model: KeypadModel, client: EgoTouchClient): void {
  const finger = new PlayedFinger();
  const { svg } = picture;
  let changed = false;
  let timer: ReturnType<typeof setInterval> | null = null;

  const send = (): void => {
    const body = finger.message(performance.now(), changed);
    if (!body) return;
    changed = false;
    client.send(body);
    if (body.case === "simulated" && !body.value.pointers?.length && timer !== null) {
      clearInterval(timer);
      timer = null;
    }
  };
  const follow = (event: PointerEvent): boolean => {
    const { place, isSkin } = picture.placeAt(event.clientX, event.clientY);
    if (!isSkin || !client.welcome?.features.includes("simulator")) {
      if (timer !== null) finger.leave(performance.now());
      return false;
    }
    finger.move(place, model.keypad, event.pointerType === "pen" && event.buttons ? event.pressure : null);
    changed = true;
    timer ??= setInterval(send, EVERY_MS);
    return true;
  };

  svg.addEventListener("pointerdown", (event) => {
    if (!follow(event)) return;
    if (event.pointerType !== "touch") svg.setPointerCapture(event.pointerId);
    finger.press(performance.now());
  });
  svg.addEventListener("pointermove", follow);
  svg.addEventListener("pointerup", (event) => {
    finger.lift();
    if (event.pointerType === "touch") finger.leave(performance.now());
  });
  svg.addEventListener("pointerleave", () => finger.leave(performance.now()));
  svg.addEventListener("pointercancel", () => finger.vanish());
  svg.addEventListener("contextmenu", (event) => event.preventDefault());
  addEventListener("blur", () => finger.vanish());
}
