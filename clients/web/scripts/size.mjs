// Prints what each entry adds to a page: `npm run size`.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const WEB = join(dirname(fileURLToPath(import.meta.url)), "..");
const { exports } = JSON.parse((await import("node:fs")).readFileSync(join(WEB, "package.json"), "utf8"));
const kilobytes = (bytes) => `${(bytes / 1000).toFixed(1).padStart(6)} kB`;

/** The goal for the client alone, in bytes of gzip. */
const GOAL = 25_000;
let core = 0;
for (const [entry, { default: file }] of Object.entries(exports)) {
  const source = join(WEB, file.replace("./dist/", "src/").replace(/\.js$/, ".ts"));
  const { outputFiles } = await build({
    entryPoints: [source], bundle: true, minify: true, format: "esm", target: "es2022", write: false, logLevel: "error",
    external: ["three", "@pmndrs/pointer-events"],
  });
  const [{ contents }] = outputFiles;
  const gzip = gzipSync(contents, { level: 9 }).length;
  if (entry === ".") core = gzip;
  console.log(`${entry.padEnd(12)} ${kilobytes(contents.length)} minified ${kilobytes(gzip)} gzip`);
}
if (core > GOAL) {
  console.error(`The client alone is over ${GOAL / 1000} kB gzip.`);
  process.exitCode = 1;
}
