// A real Chromium, and pages made of this package's sources.

import { build } from "esbuild";
import { execFileSync } from "node:child_process";
import { fileURLToPath } from "node:url";
import { chromium, type Browser, type BrowserContextOptions, type Page } from "playwright-core";

const ARGUMENTS = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
const NAMES = ["chromium", "chromium-browser", "google-chrome"];

/** The browser to test with: $EGOTOUCH_CHROMIUM, or the system's; in CI there must be one. */
export function chromiumPath(): string | null {
  if (process.env["EGOTOUCH_CHROMIUM"]) return process.env["EGOTOUCH_CHROMIUM"];
  for (const name of NAMES) {
    try {
      return execFileSync("which", [name], { encoding: "utf8" }).trim();
    } catch {
      continue;
    }
  }
  if (process.env["CI"]) throw new Error("no Chromium; install the package chromium, or set EGOTOUCH_CHROMIUM");
  return null;
}

export async function launch(...more: string[]): Promise<Browser> {
  return chromium.launch({ executablePath: chromiumPath()!, args: [...ARGUMENTS, ...more] });
}

/** The script of a page that is one module of this folder's tests. */
export async function bundled(module: string): Promise<string> {
  const entry = fileURLToPath(new URL(module, new URL("../browser/", import.meta.url)));
  const { outputFiles } = await build({ entryPoints: [entry], bundle: true, format: "esm", target: "es2022", write: false, logLevel: "error" });
  return outputFiles[0]!.text;
}

/** A page at `http://localhost/` (a secure context) with this body and script; errors in it fail the test when `close` is called. */
export async function opened(browser: Browser, body: string, script: string, options: BrowserContextOptions = {}): Promise<{ page: Page; close(): Promise<void> }> {
  const context = await browser.newContext(options);
  const page = await context.newPage();
  const errors: string[] = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.route("http://localhost/**", (route) => {
    if (route.request().url().endsWith("/script.js")) return route.fulfill({ contentType: "text/javascript", body: script });
    return route.fulfill({ contentType: "text/html", body: `<!doctype html><style>body { margin: 0 }</style>${body}<script type="module" src="/script.js"></script>` });
  });
  await page.goto("http://localhost/");
  return {
    page,
    close: async () => {
      await context.close();
      if (errors.length) throw new Error(errors.join("\n"));
    },
  };
}
