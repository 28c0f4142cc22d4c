/** A session in a headset: renders the keypad on the tracked hand until the wearer leaves. */
import type { KeypadModel } from "../keypad_model.js";
import type { ShownState } from "../words.js";
import { KeypadScene } from "./keypad_scene.js";
import { PerspectiveCamera, WebGLRenderer } from "./three_parts.js";

/** A frame never counts for longer, as after a pause. */
const LONGEST_FRAME_S = 0.1;

/** The scene that is shown, once there is one; the promise ends with the session. */
export async function runKeypadSession(
  session: XRSession,
  model: KeypadModel,
  state: () => ShownState,
  onScene: (scene: KeypadScene | null) => void = () => {},
): Promise<void> {
  const ended = new Promise<void>((resolve) => session.addEventListener("end", () => resolve(), { once: true }));
  const renderer = new WebGLRenderer({ antialias: true, alpha: true });
  const scene = new KeypadScene(model, state, session.environmentBlendMode === "opaque");
  const camera = new PerspectiveCamera(70, 1, 0.02, 20);
  try {
    renderer.xr.enabled = true;
    renderer.xr.setReferenceSpaceType(await floorOrHead(session));
    await renderer.xr.setSession(session);
    let last = 0;
    renderer.setAnimationLoop((now, frame) => {
      const space = renderer.xr.getReferenceSpace();
      if (!frame || !space) return;
      const seconds = Math.min((now - last) / 1000, LONGEST_FRAME_S);
      last = now;
      scene.update({ frame, space, sources: session.inputSources, seconds });
      renderer.render(scene, camera);
    });
    onScene(scene);
    await ended;
  } finally {
    onScene(null);
    renderer.setAnimationLoop(null);
    scene.dispose();
    renderer.dispose();
    renderer.domElement.remove();
  }
}

async function floorOrHead(session: XRSession): Promise<"local-floor" | "local"> {
  return session.requestReferenceSpace("local-floor").then(
    () => "local-floor" as const,
    () => "local" as const,
  );
}
