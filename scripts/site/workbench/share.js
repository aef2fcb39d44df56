// Sharing: a link whose fragment carries all files, and a zip that the native program runs as it is.
import { byId, el, fill } from "../../../core/view/page/dom.js";
import { packProject } from "../project/link.js";
import { MOST_PACKED, readZip, writeZip } from "../project/zip.js";

const FEW = 3; // files named that an archive has in vain
const LONG = 8000; // characters of a link that some programs cut

/** The scene of an archive: the first file in YAML that begins one, outside of mods. */
export function sceneOf(files) {
    return Object.keys(files).find((path) => path.endsWith(".yaml") && !/(^|\/)mods\//.test(path) && /^jostle:/m.test(files[path]));
}

export class Share {
    constructor(desk) {
        this.desk = desk;
        const button = (text, onclick) => el("button", { type: "button", onclick }, text);
        this.back = button("Back to what was here before", () => this.before && desk.open(this.before, "What was here before is back."));
        this.back.hidden = true;
        this.file = el("input", { type: "file", accept: ".zip,application/zip", hidden: true, onchange: () => this.file.files[0] && this.openZip(this.file.files[0]) });
        fill(byId("share").querySelector("div"), button("Copy a link", () => this.copyLink()), button("Download a zip", () => this.download()),
            button("Open a zip", () => this.file.click()), this.file, this.back, el("p", { className: "faint" }, "Both carry all files. The zip runs natively, too: unpack it, and ", el("code", {}, "jostle run SCENE --view"), "."));
        this.takeDrops(byId("left"));
    }

    /** Offers what another project has replaced: {scene, files}. */
    offerBack(before) {
        this.before = before;
        this.back.hidden = false;
    }

    /** Opens an archive that is dropped on the texts. */
    takeDrops(node) {
        node.addEventListener("dragover", (event) => [...event.dataTransfer.items].some((i) => i.kind === "file") && event.preventDefault());
        node.addEventListener("drop", (event) => {
            const [file] = event.dataTransfer.files;
            if (!file) return;
            event.preventDefault();
            this.openZip(file);
        }, true);
    }

    async link() {
        const { desk } = this, packed = await packProject({ scene: desk.scene, files: desk.texts, lesson: desk.lesson?.number ?? null });
        return `${location.origin}${location.pathname}#edit=${packed}`;
    }

    async copyLink() {
        const { desk } = this, link = await this.link().catch((error) => desk.tell(error.message));
        if (!link) return;
        const long = link.length > LONG ? ` It has ${link.length} characters, and some programs cut that: a zip has no limit.` : "";
        byId("share").open = false;
        const field = el("input", { type: "text", readOnly: true, value: link, "aria-label": "Link", onfocus: () => field.select() });
        try {
            await navigator.clipboard.writeText(link);
            desk.tell(`The link is copied. It carries all files; nothing is kept on a server.${long}`, field);
        } catch {
            desk.tell(`Copy this link. It carries all files; nothing is kept on a server.${long}`, field);
            field.focus();
        }
    }

    async download() {
        const { desk } = this, order = [desk.scene, ...Object.keys(desk.texts).filter((path) => path !== desk.scene)];
        const bytes = await writeZip(Object.fromEntries(order.map((path) => [path, desk.texts[path]])));
        const address = URL.createObjectURL(new Blob([bytes], { type: "application/zip" }));
        el("a", { href: address, download: `${desk.scene.split("/").pop().replace(/\.yaml$/, "")}.zip` }).click();
        setTimeout(() => URL.revokeObjectURL(address), 10000);
        byId("share").open = false;
        desk.tell(`The zip has ${order.length === 1 ? "1 file" : `${order.length} files`}. Natively: jostle run ${desk.scene} --view`);
    }

    async openZip(file) {
        const { desk } = this;
        byId("share").open = false;
        try {
            if (file.size > MOST_PACKED) throw new Error(`it has ${Math.round(file.size / 1e6)} MB, ${MOST_PACKED / 1e6} MB is the limit`);
            const { files, left } = await readZip(new Uint8Array(await file.arrayBuffer())), scene = sceneOf(files);
            if (!scene) throw new Error("it has no scene: a .yaml file that begins with 'jostle: 1'");
            const few = left.slice(0, FEW).join(", "), more = left.length > FEW ? ` and ${left.length - FEW} more` : "";
            await desk.open({ scene, files }, `${file.name} is opened.${left.length ? ` Left out, as they are no texts: ${few}${more}.` : ""}`);
        } catch (error) {
            desk.tell(`${file.name} was not opened: ${error.message}.`);
        }
        this.file.value = "";
    }
}
