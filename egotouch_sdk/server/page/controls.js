// The simulator's controls: what is chosen, as one object of plain values.

import { FINGER_COLOURS, FINGERS, words } from "./vocabulary.js";

const DEGREE = Math.PI / 180;
const SLIDERS = ["force", "pitch", "yaw", "hover"];
/** How far a finger comes in from the side of its hand, in degrees of the picture. */
const NATURAL_YAW_DEG = 40;

export class Controls {
  #byId;
  #finger = "INDEX";
  #view;
  #changed;

  /** `view` is the drawn limb; `changed()` is called when the finger, arm or side is another. */
  constructor(view, changed, root = document) {
    this.#byId = (id) => root.getElementById(id);
    this.#view = view;
    this.#changed = changed;
    for (const id of SLIDERS) this.#byId(id).addEventListener("input", () => this.#show(id));
    for (const finger of FINGERS) this.#byId("fingers").append(this.#fingerButton(finger));
    this.#segments("host", (value) => (view.host = value));
    this.#segments("side", (value) => (view.side = value));
    this.finger = "INDEX";
    this.#turn();
    SLIDERS.forEach((id) => this.#show(id));
  }

  get finger() {
    return this.#finger;
  }

  set finger(finger) {
    this.#finger = finger;
    for (const button of this.#byId("fingers").children) button.setAttribute("aria-pressed", String(button.dataset.finger === finger));
    this.#changed();
  }

  get settings() {
    const value = (id) => Number(this.#byId(id).value);
    return {
      finger: this.#finger,
      force_n: value("force"),
      pitch_rad: value("pitch") * DEGREE,
      yaw_rad: value("yaw") * DEGREE,
      hover_mm: value("hover"),
      hoverOnly: this.#byId("hover-only").checked,
      deviceForce: this.#byId("device-force").checked,
    };
  }

  /** Move a slider by some of its steps. */
  nudge(id, steps) {
    const slider = this.#byId(id);
    slider.value = Number(slider.value) + steps * Number(slider.step);
    this.#show(id);
  }

  toggleHoverOnly() {
    const box = this.#byId("hover-only");
    box.checked = !box.checked;
  }

  #show(id) {
    const slider = this.#byId(id);
    const shown = Number(slider.value).toFixed(Number(slider.dataset.digits ?? 0));
    slider.parentElement.querySelector("output").textContent = `${shown}${slider.dataset.unit === "°" ? "" : " "}${slider.dataset.unit}`;
  }

  /** A finger comes in from the side of the hand that touches. */
  #turn() {
    const host = this.#view.host;
    this.#byId("yaw").value = (host === "LEFT" ? -1 : 1) * this.#view.thumbwards * NATURAL_YAW_DEG;
    this.#show("yaw");
    this.#byId("hand").textContent = `of the ${host === "LEFT" ? "right" : "left"} hand`;
  }

  #segments(id, apply) {
    this.#byId(id).addEventListener("click", ({ target }) => {
      const value = target.dataset[id];
      if (!value) return;
      for (const button of this.#byId(id).children) button.setAttribute("aria-pressed", String(button === target));
      apply(value);
      this.#turn();
      this.#changed();
    });
  }

  #fingerButton(finger) {
    const button = document.createElement("button");
    Object.assign(button, { type: "button", className: "chip", textContent: words(finger) });
    button.dataset.finger = finger;
    button.style.setProperty("--chip", FINGER_COLOURS[finger]);
    button.addEventListener("click", () => (this.finger = finger));
    return button;
  }
}
