import type { Browser } from "playwright-core";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { dot, length, minus, plus, times, type Vec3 } from "../../src/webxr/vectors.js";
import { chromiumPath, launch } from "../support/browser.js";
import { PythonServer } from "../support/python_server.js";
import { headsetScripts, hold, joints, keyPlace, SMALL, WEBGL_ARGUMENTS } from "./emulated_headset.js";
import { KeypadPage, SkinFinger, until } from "./keypad_page.js";

/** The left palm before the wearer's eyes, fingers up, as one holds a phone. */
const PALM = { thumb: [-1, 0, 0], fingers: [0, 0.8, -0.6], palm: [0, 0.6, 0.8], place: [-0.02, 1.36, -0.36] } as const;

describe.skipIf(!chromiumPath())("the skin keypad in an emulated headset", { retry: 1, timeout: 150_000 }, () => {
  let browser: Browser;
  let server: PythonServer;
  let keypad: KeypadPage;
  let finger: SkinFinger;
  beforeAll(async () => (browser = await launch(...WEBGL_ARGUMENTS)));
  afterAll(async () => browser.close());
  beforeEach(async () => {
    server = new PythonServer(["simulate", "--keypad", "--no-browser"]);
    await server.start();
    await enter("immersive-vr");
    finger = await SkinFinger.on(server, keypad);
  });
  afterEach(async () => {
    finger.end();
    await server.kill();
    await keypad.close();
  });

  const enter = async (mode: "immersive-ar" | "immersive-vr"): Promise<void> => {
    keypad = await KeypadPage.open(browser, server, { viewport: SMALL }, headsetScripts(mode));
    await keypad.page.locator("#headset:not([hidden])").click();
    await shown(() => egotouch.scene?.skin.limb != null, "the session with a tracked hand");
  };
  const shown = (condition: () => boolean, what: string): Promise<void> =>
    until(async () => keypad.page.evaluate(condition), async () => what);
  const holdPalm = (at: Vec3 = PALM.place): Promise<void> => hold(keypad.page, "left", PALM.thumb, PALM.fingers, PALM.palm, at);

  test("has its keys on the palm of the tracked hand, wherever that goes", async () => {
    await holdPalm();
    await shown(() => egotouch.scene!.isShown, "the keys on the palm");
    const tracked = await keypad.page.evaluate(() => headset.activeSession!.inputSources.map(({ handedness, hand }) => [handedness, hand?.size]));
    expect(tracked).toEqual(expect.arrayContaining([["left", 25], ["right", 25]]));
    const [wrist, knuckle] = (await joints(keypad.page, "left", "wrist", "middle-finger-phalanx-proximal")) as [Vec3, Vec3];
    const five = await keyPlace(keypad.page, "5");
    // In the middle of the hand, on the palm's side of its bones.
    const off = minus(five, times(plus(wrist, knuckle), 0.5));
    expect(length(off)).toBeLessThan(0.045);
    expect(dot(off, PALM.palm)).toBeGreaterThan(0.015);
    // Read by the wearer: 1 at the upper left, # at the lower right.
    const [one, hash] = [await keyPlace(keypad.page, "1"), await keyPlace(keypad.page, "#")];
    expect(one[0]).toBeLessThan(five[0]);
    expect(one[1]).toBeGreaterThan(five[1]);
    expect(hash[0]).toBeGreaterThan(five[0]);
    expect(hash[1]).toBeLessThan(five[1]);
    const step: Vec3 = [0.05, -0.04, 0.03];
    await holdPalm(plus(PALM.place, step));
    const moved = minus(await keyPlace(keypad.page, "5"), five);
    expect(length(minus(moved, step))).toBeLessThan(0.001);
  });

  test("dials what touches on the skin press, sinks the pressed key, and keeps the number when the wearer leaves", async () => {
    await holdPalm();
    await shown(() => egotouch.scene!.isShown, "the keys on the palm");
    const height = (): Promise<number> => keypad.page.evaluate(() => egotouch.scene!.keys.find(({ key }) => key === "4")!.heightMm);
    expect(await height()).toBeCloseTo(3, 1);
    const before = await keypad.note();
    await finger.press("4", 3);
    await until(async () => (await height()) < 1, async () => `key 4 to sink from ${await height()}`);
    await finger.lift("4");
    await keypad.nextNote(before);
    await keypad.page.evaluate(() => egotouch.model.clear());
    await finger.tap("4", "9");
    await keypad.expectNumber("49");
    await finger.hold("0", "plus");
    await keypad.expectNumber("49+");
    await keypad.screenshot("headset");
    await keypad.page.evaluate(async () => headset.activeSession!.end());
    await shown(() => egotouch.scene === null, "the session's end");
    await finger.tap("1");
    await keypad.expectNumber("49+1");
  });

  test("shows no keys while the hand is lost or turned away, and dials nothing that is cancelled", async () => {
    await holdPalm();
    await shown(() => egotouch.scene!.isShown, "the keys on the palm");
    await finger.press("7");
    await keypad.page.evaluate(() => (headset.hands.left!.connected = false));
    await shown(() => !egotouch.scene!.isShown && egotouch.scene!.skin.limb === null, "the keys to go with the hand");
    await server.kill();
    await keypad.expectNote(/Nothing dialled/);
    await keypad.page.evaluate(() => (headset.hands.left!.connected = true));
    await shown(() => egotouch.scene!.isShown, "the keys to come back");
    await hold(keypad.page, "left", [1, 0, 0], PALM.fingers, times(PALM.palm, -1), PALM.place);
    await shown(() => !egotouch.scene!.isShown && egotouch.scene!.skin.limb !== null, "the keys to hide behind the hand");
    await keypad.expectNumber("");
  });

  test("lies over the real hand where the headset shows it, and draws no hands then", async () => {
    await keypad.close();
    await enter("immersive-ar");
    expect(await keypad.page.locator("#headset").textContent()).toBe("Show it on my hand");
    await holdPalm();
    await shown(() => egotouch.scene!.isShown, "the keys on the palm");
    expect(await keypad.page.evaluate(() => [egotouch.scene!.background, headset.activeSession!.environmentBlendMode])).toEqual([null, "alpha-blend"]);
    finger.end();
    finger = await SkinFinger.on(server, keypad);
    await finger.tap("3");
    await keypad.expectNumber("3");
  });
});
