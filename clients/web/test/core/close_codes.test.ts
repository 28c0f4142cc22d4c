import { afterEach, expect, test, vi } from "vitest";
import { closeAdvice } from "../../src/core/close_codes.js";
import { noAnswerAt } from "../../src/platform.js";

afterEach(() => vi.unstubAllGlobals());

test.each([
  [1006, true, true, false],
  [1006, false, true, false],
  [1001, true, true, false],
  [1009, true, false, false],
  [4001, true, true, false],
  [4008, true, true, false],
  [4400, false, false, false],
  [4401, false, false, true],
  [4403, false, false, false],
  [4409, false, false, false],
  [4422, true, false, false],
  [4499, true, false, false],
])("code %i of a connection that was live: %s", (code, wasLive, retry, access) => {
  const advice = closeAdvice(code, "", wasLive);
  expect([advice.retry, advice.access]).toEqual([retry, access]);
  expect(advice.text).toMatch(/[.?]$/);
});

test("the server's own words are added as a sentence where they say more", () => {
  expect(closeAdvice(4422, "a hello came twice", true).text).toBe("The server did not understand this client. A hello came twice.");
  expect(closeAdvice(4401, "token is missing", false).text).not.toContain("missing");
  expect(closeAdvice(4077, "back in a minute", true).text).toBe("Back in a minute.");
});

test.each([
  ["http://localhost:5173/", "ws://localhost:8765/", /running\?$/],
  ["https://app.example/", "ws://localhost:8765/", /running\?$/],
  ["https://app.example/", "ws://192.168.1.7:8765/", /came over https/],
  ["http://localhost:5173/", "wss://192.168.1.7:8765/", /open https:\/\/192\.168\.1\.7:8765\/ once/],
])("a page at %s that reaches nothing at %s is told what to look at", (page, url, words) => {
  vi.stubGlobal("location", new URL(page));
  expect(noAnswerAt(url)).toMatch(words);
  expect(closeAdvice(1006, "", false, noAnswerAt(url)).text).toMatch(words);
});
