// The simulator's controls: what is chosen, as one object of plain values.

import type { Finger, Handedness } from "../../src/index.js";
import type { LimbView, Side } from "./limb_view.js";
import type { PlayingSettings } from "./played_fingers.js";
import { byId, FINGER_COLOURS, FINGERS, words } from "./vocabulary.js";

const DEGREE = Math.PI / 180;
const SLIDERS = ["force", "pitch", "yaw", "hover"];
/** How far a finger comes in from the side of its hand, in degrees of the picture. */
const NATURAL_YAW_DEG = 40;

export class Controls {
  #finger: Finger = "index";
  readonly #view: LimbView;
  readonly #changed: () => void;

  /** `view` is the drawn limb; `changed()` is called when the finger, arm or side is another. */
  constructor(view: LimbView, changed: () => void) {
    this.#view = view;
    this.#changed = changed;
    for (const id of SLIDERS) byId(id).addEventListener("input", () => this.#show(id));
    for (const finger of FINGERS) byId("fingers").append(this.#fingerButton(finger));
    this.#segments("host", (value) => (view.host = value as Handedness));
    this.#segments("side", (value) => (view.side = value as Side));
    this.finger = "index";
    this.#turn();
    SLIDERS.forEach((id) => this.#show(id));
  }

  get finger(): Finger {
    return this.#finger;
  }

  set finger(finger: Finger) {
    this.#finger = finger;
    for (const button of byId("fingers").querySelectorAll("button")) button.setAttribute("aria-pressed", String(button.dataset["finger"] === finger));
    this.#changed();
  }

  get settings(): PlayingSettings {
    const value = (id: string) => Number(byId<HTMLInputElement>(id).value);
    return {
      finger: this.#finger,
      forceN: value("force"),
      pitchRad: value("pitch") * DEGREE,
      yawRad: value("yaw") * DEGREE,
      hoverMm: value("hover"),
      hoverOnly: byId<HTMLInputElement>("hover-only").checked,
      deviceForce: byId<HTMLInputElement>("device-force").checked,
    };
  }

  /** Move a slider by some of its steps. */
  nudge(id: string, steps: number): void {
    const slider = byId<HTMLInputElement>(id);
    slider.value = String(Number(slider.value) + steps * Number(slider.step));
    this.#show(id);
  }

  toggleHoverOnly(): void {
    const box = byId<HTMLInputElement>("hover-only");
    box.checked = !box.checked;
  }

  #show(id: string): void {
    const slider = byId<HTMLInputElement>(id);
    const { digits = 0, unit = "" } = slider.dataset;
    const shown = Number(slider.value).toFixed(Number(digits));
    slider.parentElement!.querySelector("output")!.textContent = `${shown}${unit === "°" ? "" : " "}${unit}`;
  }

  /** A finger comes in from the side of the hand that touches. */
  #turn(): void {
    const host = this.#view.host;
    byId<HTMLInputElement>("yaw").value = String((host === "left" ? -1 : 1) * this.#view.thumbwards * NATURAL_YAW_DEG);
    this.#show("yaw");
    byId("hand").textContent = `of the ${host === "left" ? "right" : "left"} hand`;
  }

  #segments(id: string, apply: (value: string) => void): void {
    byId(id).addEventListener("click", ({ target }) => {
      const value = (target as HTMLElement).dataset[id];
      if (!value) return;
      for (const button of byId(id).children) button.setAttribute("aria-pressed", String(button === target));
      apply(value);
      this.#turn();
      this.#changed();
    });
  }

  #fingerButton(finger: Finger): HTMLElement {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", className: "chip", textContent: words(finger) });
    button.dataset["finger"] = finger;
    button.style.setProperty("--chip", FINGER_COLOURS[finger]);
    button.addEventListener("click", () => (this.finger = finger));
    return button;
  }
}
