/** The skin keypad's page: a phone's keys on the wearer's palm or forearm, flat or in a headset. */
import type { Handedness, Surface } from "../../src/events.js";
import { EgoTouchClient } from "../../src/index.js";
import { layoutFromData } from "../../src/skin/index.js";
import { startWithAccess } from "../../pages/src/access.js";
import { KeypadModel } from "./keypad_model.js";
import layoutData from "./layout.json" with { type: "json" };
import { LimbPicture } from "./limb_picture.js";
import { connectMouse } from "./mouse.js";
import { NOTES, STATES } from "./words.js";
import type { KeypadScene } from "./xr/keypad_scene.js";
import { offerHeadset } from "./headset_button.js";

const find = <Type extends Element>(selector: string): Type => {
  const element = document.querySelector<Type>(selector);
  if (!element) throw new Error(`the page has no ${selector}`);
  return element;
};

// A machine too slow for the server's limit on the age of touches may raise it: ?input_ttl_ms=5000.
const inputTtlMs = Number(new URLSearchParams(location.search).get("input_ttl_ms"));
const client = new EgoTouchClient({ name: "skin keypad", subscribe: { status: true }, ...(inputTtlMs > 0 ? { inputTtlMs } : {}) });
const picture = new LimbPicture(find<SVGSVGElement>("#limb"));
let isDue = false;
const model = new KeypadModel(layoutFromData(layoutData), () => {
  if (isDue) return;
  isDue = true;
  requestAnimationFrame(draw);
});

function draw(): void {
  isDue = false;
  picture.draw(model);
  const number = find("#number");
  number.textContent = model.number;
  number.classList.toggle("long", model.number.length > 12);
  find("#display").classList.toggle("empty", model.number === "");
  find("#note").textContent = NOTES[model.note.kind](model.note);
  find<HTMLElement>("#note").dataset["kind"] = model.note.serial > 0 ? model.note.kind : "none";
  const forceN = Math.max(0, ...model.fingers.map((finger) => finger.forceN));
  find<HTMLElement>("#force").style.setProperty("--force", String(Math.min(forceN / 3.5, 1)));
  find("#newtons").textContent = forceN > 0 ? `${forceN.toFixed(1)} N` : "–";
  for (const button of document.querySelectorAll<HTMLButtonElement>("[data-host], [data-surface]")) {
    const isChosen = button.dataset["host"] === model.host || button.dataset["surface"] === model.surface;
    button.setAttribute("aria-pressed", String(isChosen));
  }
}

function showState(): void {
  const pill = find<HTMLElement>("#pill");
  pill.dataset["state"] = client.state;
  pill.textContent = STATES[client.state];
  find("#detail").textContent = client.state === "live" ? "" : client.detail;
  document.body.classList.toggle("simulated", client.welcome?.features.includes("simulator") ?? false);
}

for (const button of document.querySelectorAll<HTMLButtonElement>("[data-host]")) {
  button.addEventListener("click", () => model.choose(model.surface, button.dataset["host"] as Handedness));
}
for (const button of document.querySelectorAll<HTMLButtonElement>("[data-surface]")) {
  button.addEventListener("click", () => model.choose(button.dataset["surface"] as Surface));
}
find("#clear").addEventListener("click", () => model.clear());

client.onBatch((batch) => model.handle(batch));
client.onState(showState);
client.onWelcome(showState);
connectMouse(picture, model, client);
const page = { client, model, picture, scene: null as KeypadScene | null };
offerHeadset(find("#headset"), model, () => client.state, (scene) => (page.scene = scene));
// For the browser's console.
Object.assign(globalThis, { egotouch: page });
showState();
draw();
startWithAccess(client, find<HTMLDialogElement>("#access"));
addEventListener("pagehide", () => client.stop());
