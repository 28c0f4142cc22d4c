// Makes src/gen from the schema: `npm run generate`, or `npm run generate -- --check` to see whether the committed files are current.
// The compiler is the one of grpcio-tools in the project's virtual environment. Two files: the types (and descriptors, for tests) of
// protoc-gen-es, and the table of fields that src/wire/codec.ts reads and writes by.
import { createFileRegistry, fromBinary, ScalarType } from "@bufbuild/protobuf";
import { FileDescriptorSetSchema } from "@bufbuild/protobuf/wkt";
import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const WEB = join(dirname(fileURLToPath(import.meta.url)), "..");
const ROOT = join(WEB, "..", "..");
const GENERATED = join(WEB, "src", "gen");
const CLASSES = join("egotouch", "v1", "egotouch_pb.ts");
/** What goes over the wire; messages that neither of them holds are left out of the table. */
const WIRE = ["ServerMessage", "ClientMessage"];

function compiled() {
  const folder = mkdtempSync(join(tmpdir(), "egotouch-gen-"));
  try {
    const venv = join(ROOT, ".venv", "bin", "python");
    const python = process.env.EGOTOUCH_PYTHON ?? (existsSync(venv) ? venv : "python3");
    const plugin = join(WEB, "node_modules", ".bin", "protoc-gen-es");
    const set = join(folder, "set.bin");
    execFileSync(
      python,
      ["-m", "grpc_tools.protoc", `-I${join(ROOT, "proto")}`, `--plugin=protoc-gen-es=${plugin}`, `--es_out=${folder}`,
        "--es_opt=target=ts,import_extension=js", `--descriptor_set_out=${set}`, "egotouch/v1/egotouch.proto"],
      { stdio: "inherit" },
    );
    const registry = createFileRegistry(fromBinary(FileDescriptorSetSchema, readFileSync(set)));
    return { [CLASSES]: readFileSync(join(folder, CLASSES), "utf8"), "fields.ts": table(registry) };
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

function table(registry) {
  const reached = new Map();
  const reach = (message) => {
    if (reached.has(message.name)) return;
    reached.set(message.name, message.fields.map(row).join(""));
    for (const { message: inner } of message.fields) if (inner) reach(inner);
  };
  for (const name of WIRE) reach(registry.getMessage(`egotouch.v1.${name}`));
  const rows = [...reached].sort().map(([name, fields]) => `  ${name}: [\n${fields}  ],\n`);
  return `// @generated from egotouch/v1/egotouch.proto by scripts/generate.mjs\n
/** Of each message that goes over the wire its fields: number, name, type, and how often: "?" optional, "*" repeated, or the oneof it is in. */
export const FIELDS = {\n${rows.join("")}} as const;\n`;
}

function row({ number, localName, message, enum: values, scalar, fieldKind, oneof, proto }) {
  const type = message?.name ?? (values ? "enum" : ScalarType[scalar].toLowerCase());
  const often = fieldKind === "list" ? "*" : proto.proto3Optional ? "?" : (oneof?.localName ?? "");
  return `    [${[number, ...[localName, type, often].map((text) => JSON.stringify(text))].join(", ")}],\n`;
}

const files = compiled();
const stale = Object.entries(files).filter(([name, text]) => !existsSync(join(GENERATED, name)) || readFileSync(join(GENERATED, name), "utf8") !== text);
if (process.argv.includes("--check")) {
  for (const [name] of stale) console.error(`clients/web/src/gen/${name} is not what egotouch.proto generates; run: npm run generate`);
  process.exitCode = stale.length ? 1 : 0;
} else {
  for (const [name, text] of stale) {
    mkdirSync(dirname(join(GENERATED, name)), { recursive: true });
    writeFileSync(join(GENERATED, name), text);
  }
}
