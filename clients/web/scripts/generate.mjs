// Makes src/gen from the schema: `npm run generate`, or `npm run generate -- --check` to see whether the committed files are current.
// The compiler is the one of grpcio-tools in the project's virtual environment.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const WEB = join(dirname(fileURLToPath(import.meta.url)), "..");
const ROOT = join(WEB, "..", "..");
const MADE = join("egotouch", "v1", "egotouch_pb.ts");
const committed = join(WEB, "src", "gen", MADE);

const folder = mkdtempSync(join(tmpdir(), "egotouch-gen-"));
let text;
try {
  const python = process.env.EGOTOUCH_PYTHON ?? join(ROOT, ".venv", "bin", "python");
  const plugin = join(WEB, "node_modules", ".bin", "protoc-gen-es");
  execFileSync(
    existsSync(python) ? python : "python3",
    ["-m", "grpc_tools.protoc", `-I${join(ROOT, "proto")}`, `--plugin=protoc-gen-es=${plugin}`, `--es_out=${folder}`,
      "--es_opt=target=ts,import_extension=js", "egotouch/v1/egotouch.proto"],
    { stdio: "inherit" },
  );
  text = readFileSync(join(folder, MADE), "utf8");
} finally {
  rmSync(folder, { recursive: true, force: true });
}

if (process.argv.includes("--check")) {
  if (!existsSync(committed) || readFileSync(committed, "utf8") !== text) {
    console.error("clients/web/src/gen is not what egotouch.proto generates; run: npm run generate");
    process.exit(1);
  }
} else {
  mkdirSync(dirname(committed), { recursive: true });
  writeFileSync(committed, text);
}
