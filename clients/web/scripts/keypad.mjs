// Builds the skin keypad's page into the Python package: `node scripts/keypad.mjs [folder]`. The same sources give the same bytes.
import { build } from "esbuild";
import { copyFile, mkdir, rm } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const WEB = join(dirname(fileURLToPath(import.meta.url)), "..");
const SOURCE = join(WEB, "examples", "skin_keypad");
export const KEYPAD_FOLDER = join(WEB, "..", "..", "egotouch_sdk", "server", "page", "keypad");

/** Modules that are files of their own; the client is the one that all served pages share. */
const elsewhere = (filter, path) => ({ name: path, setup: ({ onResolve }) => onResolve({ filter }, () => ({ path, external: true })) });

export async function buildKeypad(folder = KEYPAD_FOLDER) {
  await rm(folder, { recursive: true, force: true });
  await mkdir(folder, { recursive: true });
  const shared = { bundle: true, minify: true, format: "esm", target: "es2022", charset: "utf8", logLevel: "warning", legalComments: "inline" };
  // three.js is a file of its own, loaded only by the headset's view: it changes only with its version.
  await build({ ...shared, entryPoints: [{ in: join(SOURCE, "xr", "three_parts.ts"), out: "three" }], outdir: folder });
  await build({
    ...shared,
    entryPoints: [{ in: join(SOURCE, "main.ts"), out: "keypad" }],
    outdir: folder,
    splitting: true,
    chunkNames: "[name]",
    plugins: [elsewhere(/^three$|three_parts\.js$/, "./three.js"), elsewhere(/\/src\/(index|wire\/enums)\.js$/, "../egotouch.js")],
  });
  await build({ ...shared, entryPoints: [join(SOURCE, "keypad.css")], outdir: folder, loader: { ".css": "css" } });
  await copyFile(join(SOURCE, "index.html"), join(folder, "index.html"));
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? "").href) await buildKeypad(process.argv[2]);
