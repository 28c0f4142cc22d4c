// Chromium's fake camera plays the demo clip into the page /camera.html of the real server, whose pipeline finds the hands in it.

import { execFileSync } from "node:child_process";
import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Browser, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { chromiumPath, launch } from "../support/browser.js";
import { PYTHON, PythonServer, ROOT } from "../support/python_server.js";

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

  async function open(path: string, work: (page: Page) => Promise<void>): Promise<void> {
    const page = await browser.newPage();
    const errors: string[] = [];
    page.on("pageerror", (error) => errors.push(String(error)));
    await page.goto(server.httpUrl + path);
    await page.locator("#pill[data-state=live]").waitFor();
    await work(page);
    await page.close();
    expect(errors).toEqual([]);
  }

  test("is sent to the server, which finds the hands in it; stopping releases it", { timeout: 2 * PATIENCE_MS }, async () => {
    await open("camera.html", async (page) => {
      await page.getByText("Start the camera").click();
      await page.locator("#log li", { hasText: "hover enter" }).first().waitFor({ timeout: PATIENCE_MS });
      expect(await page.locator("#size").textContent()).toBe("640 × 480 px");
      const metrics = await (await fetch(`${server.httpUrl}metrics`)).text();
      const pushed = Object.fromEntries([...metrics.matchAll(/egotouch_pushed_total\{\w+="(\w+)"\} (\d+)/g)].map(([, fate, count]) => [fate, Number(count)]));
      expect(pushed["taken"]).toBeGreaterThan(1);
      expect(pushed).toMatchObject({ damaged: 0, bad_frame: 0, time_not_rising: 0, time_jump: 0 });
      await page.getByText("Stop the camera").click();
      await page.getByText("Start the camera").waitFor();
      expect(await page.evaluate(() => document.querySelector("video"))).toBeNull();
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
