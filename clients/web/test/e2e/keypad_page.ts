// The skin keypad in a real browser, a hand that plays on the server beside it, and what a reader of the page sees.

import { mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import { WebSocket } from "ws";
import { EgoTouchClient } from "../../src/index.js";
import type { KeypadModel } from "../../examples/skin_keypad/keypad_model.js";
import type { LimbPicture } from "../../examples/skin_keypad/limb_picture.js";
import type { KeypadScene } from "../../examples/skin_keypad/xr/keypad_scene.js";
import { PATIENCE_MS, PlayedHand, type Played, type PythonServer } from "../support/python_server.js";

export const DESKTOP = { width: 1440, height: 900 };
export const PHONE = { width: 390, height: 844 };
const SCREENSHOTS = fileURLToPath(new URL("../screenshots/", import.meta.url));

declare global {
  var egotouch: { client: EgoTouchClient; model: KeypadModel; picture: LimbPicture; scene: KeypadScene | null };
}

export class KeypadPage {
  readonly #errors: string[] = [];

  private constructor(readonly page: Page) {
    page.on("pageerror", (error) => this.#errors.push(String(error)));
    page.on("console", (message) => message.type() === "error" && !message.text().includes("ERR_") && this.#errors.push(message.text()));
  }

  /** The page, live. Touches may be older than usual, as a loaded machine may hold up every one of them. */
  static async open(browser: Browser, server: PythonServer, options: BrowserContextOptions = { viewport: DESKTOP }, scripts: readonly ({ path: string } | { content: string })[] = []): Promise<KeypadPage> {
    const context = await browser.newContext(options);
    context.setDefaultTimeout(PATIENCE_MS);
    for (const script of scripts) await context.addInitScript(script);
    const opened = new KeypadPage(await context.newPage());
    await opened.page.goto(`${server.httpUrl}keypad/?input_ttl_ms=${PATIENCE_MS}`);
    await opened.expectState("live");
    return opened;
  }

  /** Close it; an error in the page fails the test. */
  async close(): Promise<void> {
    await this.page.context().close();
    if (this.#errors.length) throw new Error(this.#errors.join("\n"));
  }

  async expectState(state: string): Promise<void> {
    await this.page.locator(`#pill[data-state=${state}]`).waitFor();
  }

  /** Wait until the page shows this number and nothing else. */
  async expectNumber(number: string): Promise<void> {
    await until(async () => (await this.number()) === number, async () => `the number ${number} instead of ${await this.number()}`);
  }

  async number(): Promise<string> {
    return (await this.page.locator("#number").textContent()) ?? "";
  }

  async note(): Promise<string> {
    return (await this.page.locator("#note").textContent()) ?? "";
  }

  async expectNote(text: RegExp): Promise<void> {
    await until(async () => text.test(await this.note()), async () => `the note ${String(text)} instead of ${await this.note()}`);
  }

  /** Wait until this key is `hovered` or `pressed`, or neither. */
  async expectKey(key: string, look: "hovered" | "pressed" | "plain"): Promise<void> {
    const wanted = look === "plain" ? ":not(.hovered):not(.pressed)" : `.${look}`;
    await this.page.locator(`.key[data-key="${key}"]${wanted}`).waitFor();
  }

  /** Where a key is: in the host frame, with the surface and the touching hand. */
  async place(key: string): Promise<Required<Pick<Played, "xMm" | "yMm" | "surface" | "hand">>> {
    return this.page.evaluate((name) => {
      const { keypad } = egotouch.model;
      const [xMm, yMm] = keypad.keys.find((candidate) => candidate.key === name)!.centreMm;
      return { xMm, yMm, surface: keypad.surface, hand: keypad.host === "left" ? "right" : "left" };
    }, key);
  }

  /** Where a key is in the window. */
  async inWindow(key: string): Promise<[number, number]> {
    const [x, y] = await this.page.evaluate((name) => {
      const found = egotouch.model.keypad.keys.find((candidate) => candidate.key === name)!;
      return egotouch.picture.toWindow(found.centreMm);
    }, key);
    return [x, y];
  }

  async screenshot(name: string): Promise<void> {
    await mkdir(SCREENSHOTS, { recursive: true });
    await this.page.screenshot({ path: `${SCREENSHOTS}${name}.png` });
  }
}

/** A finger on the server's simulator that waits until the page has seen what it does. */
export class SkinFinger {
  readonly #client: EgoTouchClient;
  readonly #hand: PlayedHand;
  readonly #keypad: KeypadPage;

  private constructor(client: EgoTouchClient, keypad: KeypadPage) {
    this.#client = client;
    this.#hand = new PlayedHand(client);
    this.#keypad = keypad;
  }

  static async on(server: PythonServer, keypad: KeypadPage): Promise<SkinFinger> {
    const client = new EgoTouchClient({ url: server.url, WebSocket, name: "finger" });
    const finger = new SkinFinger(client, keypad);
    client.start();
    await finger.expectLive();
    return finger;
  }

  async expectLive(): Promise<void> {
    await until(async () => this.#client.state === "live", async () => `the finger's connection, which is ${this.#client.state}`);
  }

  async hover(key: string): Promise<void> {
    this.#hand.play(await this.#keypad.place(key));
    await this.#keypad.expectKey(key, "hovered");
  }

  async press(key: string, forceN = 1): Promise<void> {
    await this.hover(key);
    this.#hand.play({ ...(await this.#keypad.place(key)), forceN });
    await this.#keypad.expectKey(key, "pressed");
  }

  /** Hover or touch somewhere, without waiting. */
  play(...fingers: Played[]): void {
    this.#hand.play(...fingers);
  }

  /** Lift over a key; the finger stays above it. */
  async lift(key: string): Promise<void> {
    await this.hover(key);
  }

  async tap(...keys: string[]): Promise<void> {
    for (const key of keys) {
      await this.press(key);
      await this.lift(key);
    }
  }

  end(): void {
    this.#hand.end();
    this.#client.stop();
  }
}

/** Wait for what a page says; its own way to wait needs `eval`, which the page's security policy forbids. */
export async function until(condition: () => Promise<boolean>, what: () => Promise<string>): Promise<void> {
  const deadline = performance.now() + PATIENCE_MS;
  while (!(await condition())) {
    if (performance.now() > deadline) throw new Error(`waited in vain for ${await what()}`);
    await new Promise((resolve) => setTimeout(resolve, 20));
  }
}
