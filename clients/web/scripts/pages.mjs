// Builds the pages that the Python package serves: `npm run pages`, or `npm run pages -- --check` to see whether the committed ones are
// what the sources give. The same sources give the same bytes.
import { build } from "esbuild";
import { cpSync, existsSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, relative } from "node:path";
import { fileURLToPath } from "node:url";
import { buildKeypad } from "./keypad.mjs";

const WEB = join(dirname(fileURLToPath(import.meta.url)), "..");
const SOURCE = join(WEB, "pages");
const SERVED = join(WEB, "..", "..", "egotouch_sdk", "server", "page");
const SCRIPTS = ["live_view", "simulator", "camera"];
const LIBRARY = "egotouch";

/** The client is a file of its own, /egotouch.js, which pages share. */
const shared = {
  name: "shared client",
  setup: ({ onResolve }) => onResolve({ filter: /\/src\/(index|wire\/enums|dom\/index|headset\/index)\.js$/ }, () => ({ path: `./${LIBRARY}.js`, external: true })),
};

async function buildPages(folder) {
  const settings = { bundle: true, minify: true, format: "esm", target: "es2022", charset: "utf8", logLevel: "warning", legalComments: "inline", outdir: folder };
  const script = (name) => join(SOURCE, "src", `${name}.ts`);
  await build({ ...settings, entryPoints: [script(LIBRARY)] });
  await build({ ...settings, entryPoints: SCRIPTS.map(script), plugins: [shared] });
  for (const { name } of readdirSync(SOURCE, { withFileTypes: true }).filter((entry) => entry.isFile())) {
    if (name.endsWith(".html")) writeFileSync(join(folder, name), assembled(readFileSync(join(SOURCE, name), "utf8")));
    else cpSync(join(SOURCE, name), join(folder, name));
  }
  await buildKeypad(join(folder, "keypad"));
}

/** A page with what all pages share in place of `<!-- part: NAME -->`. */
const assembled = (html) => html.replace(/^ *<!-- part: (\w+) -->\n/gm, (_, name) => readFileSync(join(SOURCE, "parts", `${name}.html`), "utf8"));

const files = (folder) =>
  new Map(
    readdirSync(folder, { recursive: true, withFileTypes: true })
      .filter((entry) => entry.isFile())
      .map((entry) => join(entry.parentPath, entry.name))
      .map((path) => [relative(folder, path), readFileSync(path)]),
  );

function differences(built, served) {
  const names = new Set([...built.keys(), ...served.keys()]);
  return [...names].filter((name) => !(built.has(name) && served.has(name) && built.get(name).equals(served.get(name)))).sort();
}

const folder = mkdtempSync(join(tmpdir(), "egotouch-pages-"));
try {
  await buildPages(folder);
  if (process.argv.includes("--check")) {
    const differing = differences(files(folder), existsSync(SERVED) ? files(SERVED) : new Map());
    if (differing.length) {
      console.error(`egotouch_sdk/server/page is not what clients/web/pages gives (${differing.join(", ")}); run: npm run pages`);
      process.exitCode = 1;
    }
  } else {
    rmSync(SERVED, { recursive: true, force: true });
    mkdirSync(SERVED, { recursive: true });
    cpSync(folder, SERVED, { recursive: true });
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}
