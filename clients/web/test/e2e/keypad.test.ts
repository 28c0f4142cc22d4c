import type { Browser } from "playwright-core";
import { fileURLToPath } from "node:url";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { chromiumPath, launch } from "../support/browser.js";
import { PythonServer } from "../support/python_server.js";
import { KeypadPage, PHONE, SkinFinger, until } from "./keypad_page.js";

const SCRIPT = fileURLToPath(new URL("../../../../examples/skin_keypad/dial.yaml", import.meta.url));

describe.skipIf(!chromiumPath())("the skin keypad in a browser", { retry: 1, timeout: 150_000 }, () => {
  let browser: Browser;
  let server: PythonServer;
  let keypad: KeypadPage;
  let finger: SkinFinger;
  beforeAll(async () => (browser = await launch()));
  afterAll(async () => browser.close());
  beforeEach(async () => {
    server = new PythonServer(["simulate", "--keypad", "--no-browser"]);
    await server.start();
    keypad = await KeypadPage.open(browser, server);
    finger = await SkinFinger.on(server, keypad);
  });
  afterEach(async () => {
    finger.end();
    await server.kill();
    await keypad.close();
  });

  test("dials the keys that are tapped on the palm, and nothing else", async () => {
    await finger.tap("1", "1", "2");
    await keypad.expectNumber("112");
    await keypad.screenshot("palm");
  });

  test("shows hovering and force: the pressed key sinks deeper and its colour deepens", async () => {
    const force = (): Promise<number> =>
      keypad.page.locator('.key[data-key="5"]').evaluate((key) => Number((key as unknown as SVGElement).style.getPropertyValue("--force")));
    await finger.hover("5");
    expect(await force()).toBe(0);
    const seen = await finger.squeeze("5", [0.7, 2.8], async () => {
      await keypad.screenshot("pressed");
      return force();
    });
    expect(seen).toEqual([expect.closeTo(0.2, 1), expect.closeTo(0.8, 1)]);
    await keypad.expectNumber("5");
    await until(async () => (await force()) === 0, async () => "the key to come up");
  });

  test("gives + when 0 is held, and no 0 afterwards", async () => {
    await finger.hold("0", "plus");
    await keypad.expectNumber("+");
    await finger.tap("4");
    await keypad.expectNumber("+4");
  });

  test("erases the last digit when the finger is dragged to the left, and dials nothing then or when it is dragged elsewhere", async () => {
    await finger.tap("7", "8", "9");
    await keypad.expectNumber("789");
    // The left palm's thumb, +x, is on the wearer's left.
    await finger.drag("6", { xMm: 34, yMm: 0 }, "erased");
    await keypad.expectNumber("78");
    await finger.drag("2", { xMm: 0, yMm: 30 });
    await finger.tap("3");
    await keypad.expectNumber("783");
  });

  test("dials nothing when the server dies in a touch, says so, and works again with the next server", async () => {
    await finger.tap("4");
    await keypad.expectNumber("4");
    await finger.press("5");
    await server.kill();
    await keypad.expectNote(/Nothing dialled: the server fell silent/);
    await keypad.expectKey("5", "plain");
    await keypad.page.locator("#pill:not([data-state=live])").waitFor();
    await keypad.screenshot("disconnected");
    await server.start();
    await Promise.all([keypad.expectState("live"), finger.expectLive()]);
    await finger.lift("5");
    await finger.tap("6");
    await keypad.expectNumber("46");
  });

  test("dials nothing when the server falls silent in a touch that ends meanwhile", async () => {
    await finger.press("5");
    server.signal("SIGSTOP");
    await keypad.expectNote(/Nothing dialled: the server fell silent/);
    finger.play(await keypad.place("5"));
    server.signal("SIGCONT");
    await Promise.all([keypad.expectState("live"), finger.expectLive()]);
    await finger.lift("5");
    await finger.tap("8");
    await keypad.expectNumber("8");
  });

  test("has its keys on the forearm too, and on the hand that is touched", async () => {
    await keypad.page.locator("[data-surface=inner_forearm]").click();
    await finger.tap("6", "#");
    await keypad.expectNumber("6#");
    await keypad.screenshot("forearm");
    finger.play();
    await until(async () => keypad.page.evaluate(() => egotouch.model.fingers.length === 0), async () => "the finger to go");
    finger.play({ hand: "left", surface: "inner_forearm", xMm: 0, yMm: -60 });
    await keypad.page.locator('[data-host=right][aria-pressed="true"]').waitFor();
    await finger.tap("2");
    await keypad.expectNumber("6#2");
  });

  test("is dialled with the mouse, and with a finger on a phone's screen, where the server is the simulator", async () => {
    for (const key of ["9", "0"]) {
      await keypad.page.mouse.move(...(await keypad.inWindow(key)), { steps: 3 });
      await keypad.expectKey(key, "hovered");
      await keypad.page.mouse.down();
      await keypad.expectKey(key, "pressed");
      await keypad.page.mouse.up();
      await keypad.expectKey(key, "hovered");
    }
    expect((await keypad.number()).replace("+", "0")).toBe("90"); // on a slow machine the second one may have been long
    const phone = await KeypadPage.open(browser, server, { viewport: PHONE, deviceScaleFactor: 2, hasTouch: true, isMobile: true });
    await keypad.page.mouse.move(2, 2);
    await until(async () => phone.page.evaluate(() => egotouch.model.fingers.length === 0), async () => "the mouse to go");
    await phone.page.touchscreen.tap(...(await phone.inWindow("3")));
    await until(async () => (await phone.number()).endsWith("3"), async () => `a 3 on the phone, which shows ${await phone.number()}`);
    await phone.screenshot("phone");
    await phone.close();
  });
});

test.skipIf(!chromiumPath())("the skin keypad dials what a script taps", { retry: 1, timeout: 150_000 }, async () => {
  const server = new PythonServer(["simulate", SCRIPT, "--serve", "--no-browser"]);
  await server.start();
  const browser = await launch();
  const keypad = await KeypadPage.open(browser, server);
  // The script plays over and over, and may have begun before the page came.
  await until(async () => (await keypad.number()).includes("+49301"), async () => `+49301 in ${await keypad.number()}`);
  await keypad.close();
  await browser.close();
  await server.kill();
});
