/** The button that enters the headset's view, where there is one; three.js is loaded only then. */
import type { KeypadModel } from "./keypad_model.js";
import type { ShownState } from "./words.js";
import type { KeypadScene } from "./xr/keypad_scene.js";

/** Passthrough first: there the wearer sees the own skin below the keys. */
const MODES = [
  { mode: "immersive-ar", text: "Show it on my hand" },
  { mode: "immersive-vr", text: "Enter the headset's view" },
] as const;

export function offerHeadset(
  button: HTMLButtonElement,
  model: KeypadModel,
  state: () => ShownState,
  onScene: (scene: KeypadScene | null) => void,
): void {
  const problem = (text: string): void => {
    const line = document.querySelector("#headset-problem");
    if (line) line.textContent = text;
  };
  const offer = async (): Promise<void> => {
    for (const { mode, text } of MODES) {
      if (!(await navigator.xr?.isSessionSupported(mode).catch(() => false))) continue;
      button.textContent = text;
      button.hidden = false;
      button.onclick = () => {
        problem("");
        // Both at once: a session may only be asked for within the click.
        const session = navigator.xr!.requestSession(mode, { requiredFeatures: ["hand-tracking"], optionalFeatures: ["local-floor"] });
        Promise.all([import("./xr/keypad_session.js"), session])
          .then(([{ runKeypadSession }, started]) => runKeypadSession(started, model, state, onScene))
          .catch((error: unknown) => problem(`The headset's view did not start: ${error instanceof Error ? error.message : String(error)}`));
      };
      return;
    }
    button.hidden = true;
  };
  void offer();
  navigator.xr?.addEventListener?.("devicechange", () => void offer());
}
