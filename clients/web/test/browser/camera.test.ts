// Chromium's fake camera plays the demo clip into the page /camera.html of the real server, whose pipeline finds the hands in it.

import { execFileSync } from "node:child_process";
import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { readXRHands, type PushedHand } from "../../src/headset/index.js";
import { chromiumPath, launch } from "../support/browser.js";
import { PYTHON, PythonServer, ROOT } from "../support/python_server.js";
import { EmulatedHand } from "../webxr/emulated_hand.js";

/** The demo clip as the Motion JPEG that Chromium's fake camera plays over and over. */
const TO_MJPEG = `
import sys, cv2
clip = cv2.VideoCapture("egotouch_sdk/assets/demo.mp4")
with open(sys.argv[1], "wb") as file:
    while (frame := clip.read())[0]:
        file.write(cv2.imencode(".jpg", frame[1], [cv2.IMWRITE_JPEG_QUALITY, 85])[1].tobytes())
`;
/** The whole pipeline and a browser share the machine's cores. */
const PATIENCE_MS = 150_000;

describe.skipIf(chromiumPath() === null)("this device's camera", { retry: 1 }, () => {
  let browser: Browser;
  let server: PythonServer;

  beforeAll(async () => {
    const clip = join(mkdtempSync(join(tmpdir(), "egotouch-clip-")), "demo.mjpeg");
    execFileSync(PYTHON, ["-c", TO_MJPEG, clip], { cwd: ROOT });
    server = new PythonServer(["serve", "client"]);
    [browser] = await Promise.all([
      launch("--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream", `--use-file-for-fake-video-capture=${clip}`),
      server.start(),
    ]);
  });
  afterAll(async () => {
    await browser.close();
    await server.kill();
  });

  /** What became of the frames that were pushed, as the server's own metrics say. */
  async function pushed(): Promise<Record<string, number>> {
    const metrics = await (await fetch(`${server.httpUrl}metrics`)).text();
    return Object.fromEntries([...metrics.matchAll(/egotouch_pushed_total\{\w+="(\w+)"\} (\d+)/g)].map(([, fate, count]) => [fate!, Number(count)]));
  }

  async function open(path: string, work: (page: Page) => Promise<void>): Promise<void> {
    const page = await browser.newPage();
    const errors: string[] = [];
    page.on("pageerror", (error) => errors.push(String(error)));
    try {
      await page.goto(server.httpUrl + path);
      await page.locator("#pill[data-state=live]").waitFor();
      await work(page);
    } finally {
      await page.close(); // the next page may be the source
    }
    expect(errors).toEqual([]);
  }

  test("is sent to the server, which finds the hands in it; stopping releases it", { timeout: 2 * PATIENCE_MS }, async () => {
    await open("camera.html", async (page) => {
      await page.getByText("Start the camera").click();
      await page.locator("#log li", { hasText: "hover enter" }).first().waitFor({ timeout: PATIENCE_MS });
      await page.locator("#size", { hasText: "640 × 480 px" }).waitFor();
      expect((await pushed())["taken"]).toBeGreaterThan(1);
      expect(await pushed()).toMatchObject({ damaged: 0, bad_frame: 0, time_not_rising: 0, time_jump: 0 });
      await page.getByText("Stop the camera").click();
      await page.getByText("Start the camera").waitFor();
      expect(await page.evaluate(() => document.querySelector("video"))).toBeNull();
    });
  });

  test("may come with the headset's own hands, which the server takes in place of its own search", { timeout: 2 * PATIENCE_MS }, async () => {
    const camera = { fxPx: 600, fyPx: 600, cxPx: 320, cyPx: 240 };
    const hands = (["left", "right"] as const).flatMap((side) => {
      const hand = new EmulatedHand(side);
      hand.move([side === "left" ? -0.08 : 0.08, -0.05, -0.4], [0, 0, 0, 1]);
      return readXRHands(hand.frame as XRFrame, [hand.source] as never, {}, camera);
    });
    expect(hands.map(({ handedness }) => handedness)).toEqual(["left", "right"]);
    await open("camera.html", async (page) => {
      const before = await pushed();
      await page.evaluate("import('/egotouch.js').then((module) => void Object.assign(globalThis, { module }))");
      const warnings = await page.evaluate(async (pushedHands: PushedHand[]) => {
        const { EgoTouchClient, sendCamera } = (globalThis as unknown as { module: typeof import("../../pages/src/egotouch.js") }).module;
        const warnings: string[] = [];
        const client = new EgoTouchClient().start();
        client.onWarning(({ code }) => void warnings.push(code));
        const seen = new Promise<void>((resolve) => client.onStatus(({ handsInView }) => handsInView === 2 && resolve()));
        await new Promise<void>((resolve) => client.onWelcome(() => resolve()));
        const source = await sendCamera(client, { fps: 10, hands: () => pushedHands });
        await seen;
        source.stop();
        await source.ended;
        client.stop();
        return warnings;
      }, hands);
      expect(warnings).toEqual([]);
      expect((await pushed())["taken"]).toBeGreaterThan(before["taken"]!);
      expect(await pushed()).toMatchObject({ hands_missing: 0, frame_missing: 0, bad_frame: 0 });
    });
  });

  test("is told why there is none", async () => {
    await open("camera.html", async (page) => {
      await page.evaluate(() => {
        navigator.mediaDevices.getUserMedia = () => Promise.reject(new DOMException("Permission denied", "NotAllowedError"));
      });
      await page.getByText("Start the camera").click();
      await page.locator("#notice", { hasText: "Allow the camera for this page" }).waitFor();
    });
  });

  test("the live view of such a server leads to the page", async () => {
    await open("", async (page) => {
      await page.locator("#to-camera").click();
      await page.getByText("Start the camera").waitFor();
    });
  });
});
