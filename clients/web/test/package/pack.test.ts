// What `npm pack` makes installs in an empty project, runs there without a build step, and has types.

import { execFile } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { afterAll, beforeAll, expect, test } from "vitest";

const WEB = fileURLToPath(new URL("../../", import.meta.url));
const TSC = join(WEB, "node_modules", "typescript", "bin", "tsc");

let project: string;

/** What a command printed, and the complaint it ended with. */
function run(command: string, args: readonly string[], cwd = project): Promise<string> {
  return new Promise((resolve) => execFile(command, args, { cwd }, (error, stdout, stderr) => resolve(stdout + (error ? stderr || String(error) : ""))));
}

beforeAll(async () => {
  project = mkdtempSync(join(tmpdir(), "egotouch-pack-"));
  const [packed] = JSON.parse(await run("npm", ["pack", "--json", "--silent", "--pack-destination", project], WEB)) as [{ filename: string }];
  writeFileSync(join(project, "package.json"), JSON.stringify({ name: "empty", private: true, type: "module" }));
  await run("npm", ["install", "--silent", "--no-audit", "--no-fund", "--prefer-offline", "--omit=peer", `./${packed.filename}`]);
}, 240_000);

afterAll(() => rmSync(project, { recursive: true, force: true }));

const APP = `
import { EgoTouchClient } from "@egotouch/client";
import { placeOn } from "@egotouch/client/dom";
import { project } from "@egotouch/client/headset";
import { FakeServer } from "@egotouch/client/testing";
import { anchorFromXRHand } from "@egotouch/client/webxr";

const server = new FakeServer();
const client = new EgoTouchClient(server.options());
const heard: string[] = [];
client.onClick((event) => void heard.push(\`\${event.type} of the \${event.finger} at \${event.xMm}, \${event.yMm} mm\`), { surface: "palm" });
server.connect(client);
server.finger().tap(3, 40).leave();
console.log(heard.join(), client.state, typeof placeOn, typeof project, typeof anchorFromXRHand);
`;

test("it runs in Node by plain imports, with one package besides", async () => {
  writeFileSync(join(project, "app.mjs"), APP.replace(": string[]", ""));
  expect((await run(process.execPath, ["app.mjs"])).trim()).toBe("click of the index at 3, 40 mm live function function function");
  const { packages } = JSON.parse(readFileSync(join(project, "package-lock.json"), "utf8")) as { packages: Record<string, unknown> };
  expect(Object.keys(packages).sort()).toEqual(["", "node_modules/@bufbuild/protobuf", "node_modules/@egotouch/client"]);
});

test("the examples of the README are right", async () => {
  const blocks = [...readFileSync(join(WEB, "README.md"), "utf8").matchAll(/```ts\n(.*?)```/gs)].map(([, code]) => code!);
  expect(blocks).toHaveLength(3);
  const given = `
import { EgoTouchClient } from "@egotouch/client";
import { attachPointerEvents } from "@egotouch/client/dom";
import { FakeServer } from "@egotouch/client/testing";
declare function startMyApp(client: EgoTouchClient): void;
`;
  const [first, ...others] = blocks;
  writeFileSync(join(project, "readme0.ts"), first!);
  others.forEach((code, i) => {
    const declared = code.includes("const client") ? "" : "declare const client: EgoTouchClient;\n";
    
    writeFileSync(join(project, `readme${i + 1}.ts`), given + declared + code);
  });
  const args = ["--noEmit", "--strict", "--target", "es2022", "--lib", "es2022,dom", "--module", "nodenext"];
  expect(await run(process.execPath, [TSC, ...args, "readme0.ts", "readme1.ts", "readme2.ts"])).toBe("");
});

test.each(["nodenext", "bundler"])("it has types, as seen with the module resolution %s", async (resolution) => {
  // What WebXR is, its own types say: with the module webxr, apps install @types/webxr.
  const app = APP.replace(/^.*webxr.*$/m, "").replace(", typeof anchorFromXRHand", "");
  writeFileSync(join(project, "app.ts"), app);
  const module = resolution === "bundler" ? "esnext" : resolution;
  const args = ["--noEmit", "--strict", "--target", "es2022", "--lib", "es2022,dom", "--module", module, "--moduleResolution", resolution, "app.ts"];
  expect(await run(process.execPath, [TSC, ...args])).toBe("");
});
