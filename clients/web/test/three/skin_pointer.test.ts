import type { PointerEvent } from "@pmndrs/pointer-events";
import { Mesh, MeshBasicMaterial, PerspectiveCamera, PlaneGeometry, Scene } from "three";
import { afterEach, beforeEach, describe, expect, test } from "vitest";
import type { TouchEvent } from "../../src/events.js";
import { SkinSurface } from "../../src/three/index.js";
import { SkinPointers, type SkinPointerState } from "../../src/three/skin_pointer.js";
import { touchEvent } from "../support/events.js";
import { EmulatedHand } from "../webxr/emulated_hand.js";

const LISTENED = ["pointerenter", "pointerleave", "pointerdown", "pointerup", "pointercancel", "click"] as const;
const ON = { xMm: 0, yMm: 50 };
const BESIDE = { xMm: 30, yMm: 50 };

describe("a finger on a key in three.js", () => {
  const hand = new EmulatedHand("left");
  let skin: SkinSurface;
  let key: Mesh;
  let pointers: SkinPointers;
  let heard: string[];
  let clock: bigint;

  beforeEach(() => {
    const scene = new Scene();
    skin = new SkinSurface({ host: "left", surface: "palm" });
    key = new Mesh(new PlaneGeometry(14, 14), new MeshBasicMaterial());
    skin.localPlace(ON, 1, key.position);
    scene.add(skin.add(key));
    skin.track(hand.frame, {} as XRSpace, [hand.source]);
    scene.updateMatrixWorld(); // as a renderer does in every frame
    heard = [];
    for (const name of LISTENED) key.addEventListener(name, () => heard.push(name));
    const camera = new PerspectiveCamera();
    pointers = new SkinPointers({ scene, surfaces: [skin], camera: () => camera });
    clock = 0n;
  });

  afterEach(() => pointers.clear());

  const send = (fields: Partial<TouchEvent>): void => pointers.handle(touchEvent({ timestampNs: (clock += 20_000_000n), ...fields }));

  test("is hovered over, pressed and clicked", () => {
    send({ type: "hover_enter", ...BESIDE });
    expect(heard).toEqual([]);
    send({ type: "hover_move", ...ON });
    send({ type: "down", forceN: 1, ...ON });
    send({ type: "up", ...ON });
    send({ type: "hover_move", ...BESIDE });
    send({ type: "hover_exit", ...BESIDE });
    expect(heard).toEqual(["pointerenter", "pointerdown", "pointerup", "click", "pointerleave"]);
    expect(pointers.size).toBe(0);
  });

  test("reads force and angles from the pointer's state", () => {
    let state: SkinPointerState | undefined;
    key.addEventListener("pointerdown", (event: PointerEvent) => (state = event.pointerState as SkinPointerState));
    send({ type: "hover_enter", ...ON });
    send({ type: "down", forceN: 2.5, pitchRad: 0.9, ...ON });
    expect(state?.touch).toMatchObject({ forceN: 2.5, pitchRad: 0.9 });
  });

  test("does not click when the touch is cancelled, held, late, or lifted beside the key", () => {
    send({ type: "hover_enter", ...ON });
    send({ type: "down", forceN: 1, ...ON });
    send({ type: "cancel", reason: "tracking_lost", ...ON });
    expect(heard).toEqual(["pointerenter", "pointerdown", "pointercancel"]);
    send({ type: "down", forceN: 1, ...ON });
    clock += 500_000_000n;
    send({ type: "up", ...ON });
    send({ type: "down", forceN: 1, late: true, ...ON });
    send({ type: "up", ...ON });
    send({ type: "down", forceN: 1, ...ON });
    send({ type: "move", forceN: 1, ...BESIDE });
    send({ type: "up", ...BESIDE });
    expect(heard).not.toContain("click");
  });

  test("is let go without a click when the hand is lost, and can be pressed again afterwards", () => {
    send({ type: "hover_enter", ...ON });
    send({ type: "down", forceN: 1, ...ON });
    skin.place(null);
    pointers.update();
    send({ type: "up", ...ON });
    expect(heard).toEqual(["pointerenter", "pointerdown", "pointercancel", "pointerleave"]);
    skin.track(hand.frame, {} as XRSpace, [hand.source]);
    heard.length = 0;
    send({ type: "down", forceN: 1, ...ON });
    send({ type: "up", ...ON });
    expect(heard).toEqual(["pointerenter", "pointerdown", "pointerup", "click"]);
  });

  test("cancels what is down when all fingers are taken away", () => {
    send({ type: "hover_enter", ...ON });
    send({ type: "down", forceN: 1, ...ON });
    pointers.clear();
    expect(heard).toEqual(["pointerenter", "pointerdown", "pointercancel", "pointerleave"]);
    expect([pointers.size, globalThis.pointerEventspointerMap?.size]).toEqual([0, 0]);
  });

  test("feels several fingers apart", () => {
    send({ type: "hover_enter", pointerId: 1, ...ON });
    send({ type: "hover_enter", pointerId: 2, finger: "middle", ...BESIDE });
    send({ type: "down", pointerId: 2, forceN: 1, ...BESIDE });
    send({ type: "down", pointerId: 1, forceN: 1, ...ON });
    send({ type: "up", pointerId: 2, ...BESIDE });
    send({ type: "up", pointerId: 1, ...ON });
    expect(heard).toEqual(["pointerenter", "pointerdown", "pointerup", "click"]);
    pointers.clear();
  });
});
