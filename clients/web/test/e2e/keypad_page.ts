// The skin keypad in a real browser, a hand that plays on the server beside it, and what a reader of the page sees.

import { mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import type { Browser, BrowserContextOptions, Page } from "playwright-core";
import { WebSocket } from "ws";
import { EgoTouchClient } from "../../src/index.js";
import type { KeypadModel, Note } from "../../examples/skin_keypad/keypad_model.js";
import type { LimbPicture } from "../../examples/skin_keypad/limb_picture.js";
import type { KeypadScene } from "../../examples/skin_keypad/xr/keypad_scene.js";
import { PATIENCE_MS, PlayedHand, type Played, type PythonServer } from "../support/python_server.js";

export const DESKTOP = { width: 1440, height: 900 };
export const PHONE = { width: 390, height: 844 };
const SCREENSHOTS = fileURLToPath(new URL("../screenshots/", import.meta.url));

/** How long and how often a finger tries. */
const TRY_MS = 5000;
const TRIES = 6;

type Look = "hovered" | "pressed" | "plain";
const keyWith = (key: string, look: Look): string =>
  `.key[data-key="${key}"]${look === "plain" ? ":not(.hovered):not(.pressed)" : `.${look}`}`;

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

  /** What happened last on the keypad. */
  async note(): Promise<Note> {
    return this.page.evaluate(() => egotouch.model.note);
  }

  /** The first thing that happens after `before`. */
  async nextNote(before: Note): Promise<Note> {
    await until(async () => (await this.note()).serial > before.serial, async () => `something after ${JSON.stringify(before)}`);
    return this.note();
  }

  /** Wait until the page says this. */
  async expectNote(text: RegExp): Promise<void> {
    const said = async (): Promise<string> => (await this.page.locator("#note").textContent()) ?? "";
    await until(async () => text.test(await said()), async () => `the note ${String(text)} instead of ${await said()}`);
  }

  /** Wait until this key is `hovered` or `pressed`, or neither. */
  async expectKey(key: string, look: Look): Promise<void> {
    await this.page.locator(keyWith(key, look)).waitFor();
  }

  /** The same for a while; false when it does not happen. */
  async isKey(key: string, look: Look, timeout: number): Promise<boolean> {
    return this.page.locator(keyWith(key, look)).waitFor({ timeout }).then(() => true, () => false);
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

  /** Press a key and stay on it. */
  async press(key: string, forceN = 1): Promise<void> {
    await this.#again(`press ${key}`, async () => {
      await this.hover(key);
      this.#hand.play({ ...(await this.#keypad.place(key)), forceN });
      return this.#keypad.isKey(key, "pressed", TRY_MS);
    });
  }

  /** Press with all of these forces, one after the other, and lift: what `seen` gives for each. */
  async squeeze<Seen>(key: string, forcesN: readonly number[], seen: () => Promise<Seen>): Promise<Seen[]> {
    const found: Seen[] = [];
    await this.#again(`press ${key} with ${forcesN.join(", ")} N`, async () => {
      found.length = 0;
      const before = await this.#keypad.note();
      for (const forceN of forcesN) {
        if (found.length === 0) await this.press(key, forceN);
        this.#hand.play({ ...(await this.#keypad.place(key)), forceN });
        const shown = this.#keypad.page.locator("#newtons", { hasText: `${forceN.toFixed(1)} N` });
        if (!(await shown.waitFor({ timeout: TRY_MS }).then(() => true, () => false))) return false;
        found.push(await seen());
      }
      await this.lift(key);
      return (await this.#keypad.nextNote(before)).kind === "key";
    });
    return found;
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
      await this.#again(`tap ${key}`, async () => {
        const before = await this.#keypad.note();
        await this.press(key);
        await this.lift(key);
        return (await this.#keypad.nextNote(before)).kind !== "cancelled";
      });
    }
  }

  /** Press a key until a note of this kind comes, and lift. */
  async hold(key: string, kind: Note["kind"]): Promise<void> {
    await this.#again(`hold ${key}`, async () => {
      const before = await this.#keypad.note();
      await this.press(key);
      const note = await this.#keypad.nextNote(before);
      await this.lift(key);
      return note.kind === kind;
    });
  }

  /** Press a key, slide off it by this way, and lift there; `kind` is what that must lead to. */
  async drag(key: string, by: { readonly xMm: number; readonly yMm: number }, kind?: Note["kind"]): Promise<void> {
    await this.#again(`drag from ${key}`, async () => {
      const before = await this.#keypad.note();
      const from = await this.#keypad.place(key);
      await this.press(key);
      const at = (share: number, forceN: number): Played => ({ ...from, xMm: from.xMm + share * by.xMm, yMm: from.yMm + share * by.yMm, forceN });
      for (const share of [0.3, 0.6, 1]) this.#hand.play(at(share, 1));
      await this.#keypad.expectKey(key, "plain");
      this.#hand.play(at(1, 0));
      return kind === undefined || (await this.#keypad.nextNote(before)).kind === kind;
    });
  }

  /** A machine without time to spare cuts touches, as it should: they are cancelled, and a person would try again. */
  async #again(what: string, act: () => Promise<boolean>): Promise<void> {
    for (let i = 0; i < TRIES; i += 1) if (await act()) return;
    throw new Error(`tried ${TRIES} times to ${what}; last: ${JSON.stringify(await this.#keypad.note())}`);
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
