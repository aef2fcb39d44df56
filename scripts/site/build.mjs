// Builds the playground, a static site: `make site` runs it. build.mjs OUT JOSTLE ENGINE NODE: the folder of the site, the program, the
// folder of the engine's module (`make wasm`), and the one of npm's packages.
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createHash } from "node:crypto";
import { createRequire } from "node:module";
import { basename, dirname, join, relative, resolve } from "node:path";
import process from "node:process";
import { fileURLToPath } from "node:url";
import { readLessons } from "./make/lessons.mjs";
import { makeGallery } from "./make/scenes.mjs";
import { readDefinitions, readSchema } from "./make/words.mjs";
import { filesOf } from "./project/references.js";

const here = dirname(fileURLToPath(import.meta.url)), root = resolve(here, "../..");
const [out, jostle, engine, node] = process.argv.slice(2).map((path) => resolve(path));
const esbuild = createRequire(join(node, "package.json"))("esbuild");
const LEFT = ["A test"]; // sections of the tutorial that need a terminal

const read = (path) => (existsSync(join(root, path)) ? readFileSync(join(root, path), "utf8") : undefined);
const escape = (text) => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
const packages = join(node, "node_modules");

/** Puts the playground's connection in the place of the page's. */
const connection = {
    name: "connection",
    setup(build) {
        build.onResolve({ filter: /net\/connection\.js$/ }, ({ importer }) => (importer.startsWith(here) ? undefined : { path: join(here, "page/connection.js") }));
    },
};
/** Finds what Emscripten has made, beside which the engine's interface lies once it is built. */
const module = {
    name: "module",
    setup(build) {
        build.onResolve({ filter: /^\.\/jostle\.mjs$/ }, () => ({ path: join(engine, "jostle.mjs") }));
    },
};
const common = { bundle: true, format: "esm", minify: true, legalComments: "none", logLevel: "warning", nodePaths: [packages], charset: "utf8" };

async function bundle() {
    const outdir = out;
    await Promise.all([
        esbuild.build({ ...common, entryPoints: [join(root, "core/view/page/main.js")], outfile: join(out, "page/main.js"), plugins: [connection] }),
        esbuild.build({ ...common, entryPoints: { worker: join(here, "engine/worker.js") }, outdir, plugins: [module] }),
        esbuild.build({ ...common, entryPoints: { gallery: join(here, "gallery/gallery.js") }, outdir }),
        // The editor is a module of its own, which main.js loads when the crowd moves.
        esbuild.build({ ...common, entryPoints: { workbench: join(here, "workbench/main.js") }, outdir, external: ["./desk.js"] }),
        esbuild.build({ ...common, format: "iife", entryPoints: { early: join(here, "workbench/early.js") }, outdir }),
        esbuild.build({ ...common, entryPoints: { desk: join(here, "workbench/desk.js") }, outdir }),
    ]);
}

function card({ name, title, about, people, picture }) {
    return `<a class="card" href="workbench.html#scene=${name}"><img src="${picture}" alt="" loading="lazy" width="320" height="200"><h3>${escape(title)}</h3>`
        + `<p>${escape(about)}</p><p class="faint">${people.toLocaleString("en")} ${people === 1 ? "person" : "people"}${people > 5000 ? ", for fast machines" : ""}</p></a>`;
}

function writeGallery() {
    const subjects = makeGallery({ root, jostle, out, cache: `${out}-previews`, pictures: [join(root, "build/out/gallery"), join(here, "pictures")], read });
    const html = subjects.filter(({ scenes }) => scenes.length).map(({ title, text, scenes }) =>
        `<section><h2>${escape(title)}</h2><p class="faint">${escape(text)}</p><div class="cards">${scenes.map(card).join("\n")}</div></section>`).join("\n");
    writeFileSync(join(out, "index.html"), readFileSync(join(here, "gallery/index.html"), "utf8").replace("<!-- scenes -->", () => html));
}

function writeData() {
    mkdirSync(join(out, "data"), { recursive: true });
    writeFileSync(join(out, "data/lessons.json"), JSON.stringify({ lessons: readLessons(read("behaviours/README.md"), LEFT) }));
    const words = { ...readDefinitions(read("scripts/editor/jostle.lua")), scene: readSchema(JSON.parse(read("scripts/scene.schema.json"))),
        behaviours: readdirSync(join(root, "behaviours")).filter((name) => name.endsWith(".lua")) };
    writeFileSync(join(out, "data/words.json"), JSON.stringify(words));
}

/** The files that each scene reads, so that it begins before all that is shipped is loaded. */
function writeScenes() {
    const shipped = JSON.parse(readFileSync(join(engine, "shipped.json"), "utf8")), among = (paths) => Object.fromEntries(paths.map((path) => [path, shipped[path]]));
    mkdirSync(join(out, "data/scenes"), { recursive: true });
    for (const scene of Object.keys(shipped).filter((path) => /^scenes\/[^/]+\.yaml$/.test(path))) {
        const files = among(filesOf(scene, (path) => shipped[path], (folder) => Object.keys(shipped).filter((path) => path.startsWith(folder))));
        writeFileSync(join(out, "data/scenes", `${basename(scene, ".yaml")}.json`), JSON.stringify({ files, installed: among(["scripts/crowd.lua"]) })); // which machines of journeys require
    }
}

/** The service worker, and the files that it keeps: all but previews. */
function writeOffline() {
    const files = readdirSync(out, { recursive: true, withFileTypes: true }).filter((f) => f.isFile()).map((f) => relative(out, join(f.parentPath ?? f.path, f.name)).replaceAll("\\", "/"))
        .filter((path) => !path.startsWith("previews/")).sort();
    writeFileSync(join(out, "data/files.json"), JSON.stringify(["./", ...files]));
    const build = createHash("sha256");
    for (const path of files) build.update(path).update(readFileSync(join(out, path)));
    writeFileSync(join(out, "offline.js"), `${readFileSync(join(here, "offline.js"), "utf8")}// ${build.digest("hex").slice(0, 16)}\n`);
}

/** The licences of what is bundled. */
function writeLicences() {
    const names = ["three", ...readdirSync(join(packages, "@codemirror")).map((n) => `@codemirror/${n}`), ...readdirSync(join(packages, "@lezer")).map((n) => `@lezer/${n}`), "style-mod", "crelt", "w3c-keyname", "@marijn/find-cluster-break"];
    const texts = names.filter((name) => existsSync(join(packages, name, "LICENSE"))).map((name) => `${name}\n\n${readFileSync(join(packages, name, "LICENSE"), "utf8")}`);
    writeFileSync(join(out, "licences.txt"), texts.join("\n\n----\n\n"));
}

rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, "page"), { recursive: true });
for (const file of ["index.html", "style.css", "icon.svg"]) cpSync(join(root, "core/view/page", file), join(out, "page", file));
cpSync(engine, join(out, "engine"), { recursive: true });
cpSync(join(here, "site.css"), join(out, "site.css"));
cpSync(join(here, "workbench/workbench.html"), join(out, "workbench.html"));
await bundle();
writeData();
writeScenes();
writeGallery();
writeLicences();
writeOffline();
cpSync(join(here, "pictures/poster.webp"), join(out, "previews/poster.webp"));
