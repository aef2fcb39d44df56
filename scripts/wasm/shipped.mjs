// Prints shipped.json: the texts, by path, of the Lua library, behaviours, scenes and mods that come with the engine.
import { readdirSync, readFileSync } from "node:fs";
import process from "node:process";

const TAKEN = { scripts: /^[^/]+\.lua$/, behaviours: /^[^/]+\.lua$/, scenes: /^([^/]+\.(yaml|wkt|dxf|input|csv|svg)|mods\/.+\.(yaml|lua|md))$/ };
const files = {};
for (const [folder, pattern] of Object.entries(TAKEN)) {
    for (const path of readdirSync(folder, { recursive: true }).sort()) {
        if (pattern.test(path)) files[`${folder}/${path}`] = readFileSync(`${folder}/${path}`, "utf8");
    }
}
process.stdout.write(JSON.stringify(files));
