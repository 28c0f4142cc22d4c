// A headset emulated by iwer in the page: its hands are where a test puts them.

import { fileURLToPath } from "node:url";
import type { Page } from "playwright-core";
import type { XRDevice } from "iwer";
import type { Handedness } from "../../src/events.js";

type Vec3 = readonly [number, number, number];

declare global {
  var headset: XRDevice;
}

/** WebGL without a graphics card, and a page small enough for it. */
export const WEBGL_ARGUMENTS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"];
export const SMALL = { width: 400, height: 300 };

/** A Quest 3 in the page, with this kind of session only: the real world behind the picture, or none. */
export const headsetScripts = (mode: "immersive-ar" | "immersive-vr"): ({ path: string } | { content: string })[] => [
  { path: fileURLToPath(new URL("../../node_modules/iwer/build/iwer.min.js", import.meta.url)) },
  {
    content: `if (globalThis.IWER) {
      globalThis.headset = new IWER.XRDevice({ ...IWER.metaQuest3, supportedSessionModes: ["inline", "${mode}"] }, { fovy: 0.6 });
      headset.installRuntime({ forceInstall: true });
      headset.primaryInputMode = "hand";
      headset.position.set(0, 1.6, 0);
      headset.quaternion.set(-0.33, 0, 0, 0.944);
    }`,
  },
];

/** Turn a hand so that its thumb's side, its fingers and its palm point in these directions, and move it to a place. */
export async function hold(page: Page, side: Handedness, thumb: Vec3, fingers: Vec3, palm: Vec3, place: Vec3): Promise<void> {
  const inPage = ({ side, wanted, place }: { side: Handedness; wanted: readonly Vec3[]; place: Vec3 }): void => {
    const { scene } = egotouch;
    const hand = headset.hands[side];
    if (!scene?.skin.limb || !hand) throw new Error("no hand is tracked");
    const { limb } = scene.skin;
    // The hand's own axes, with its present turn taken back: q* v q.
    const { x, y, z, w } = hand.quaternion;
    const unturned = (v: Vec3): Vec3 => {
      const t = [2 * (z * v[1] - y * v[2]), 2 * (x * v[2] - z * v[0]), 2 * (y * v[0] - x * v[1])] as const;
      return [v[0] + w * t[0] + z * t[1] - y * t[2], v[1] + w * t[1] + x * t[2] - z * t[0], v[2] + w * t[2] + y * t[0] - x * t[1]];
    };
    const own = [unturned(limb.thumb), unturned(limb.fingers), unturned(limb.palm)];
    const r = [0, 1, 2].map((i) => [0, 1, 2].map((j) => [0, 1, 2].reduce((sum, axis) => sum + wanted[axis]![i]! * own[axis]![j]!, 0)));
    const part = (a: number, b: number, c: number): number => Math.sqrt(Math.max(0, 1 + a * r[0]![0]! + b * r[1]![1]! + c * r[2]![2]!)) / 2;
    const signed = (value: number, by: number): number => (by < 0 ? -value : value);
    hand.quaternion.set(
      signed(part(1, -1, -1), r[2]![1]! - r[1]![2]!),
      signed(part(-1, 1, -1), r[0]![2]! - r[2]![0]!),
      signed(part(-1, -1, 1), r[1]![0]! - r[0]![1]!),
      part(1, 1, 1),
    );
    hand.position.set(...place);
  };
  await page.evaluate(inPage, { side, wanted: [thumb, fingers, palm], place });
}

/** Where joints of a hand are, as the running session says. */
export async function joints(page: Page, side: Handedness, ...names: XRHandJoint[]): Promise<Vec3[]> {
  return page.evaluate(
    async ({ side, names }) => {
      const session = headset.activeSession as unknown as XRSession;
      const space = await session.requestReferenceSpace("local-floor");
      const source = [...session.inputSources].find(({ handedness, hand }) => handedness === side && hand);
      return new Promise<Vec3[]>((resolve) =>
        session.requestAnimationFrame((_, frame) =>
          resolve(
            names.map((name): Vec3 => {
              const position = frame.getJointPose!(source!.hand!.get(name)!, space)!.transform.position;
              return [position.x, position.y, position.z];
            }),
          ),
        ),
      );
    },
    { side, names },
  );
}

/** Where a key is in the session's space, after the next frame was drawn. */
export async function keyPlace(page: Page, key: string): Promise<Vec3> {
  return page.evaluate(async (name): Promise<Vec3> => {
    const session = headset.activeSession as unknown as XRSession;
    for (let i = 0; i < 2; i += 1) await new Promise((resolve) => session.requestAnimationFrame(resolve));
    const [x, y, z] = egotouch.scene!.keys.find((mesh) => mesh.key === name)!.matrixWorld.elements.slice(12, 15);
    return [x!, y!, z!];
  }, key);
}
