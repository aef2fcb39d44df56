// Folders of the module's file system (FS of Emscripten), each of which has the files of a scene.
import { cleanParts } from "./arguments.mjs";

const encoder = new TextEncoder();

/** A text as UTF-8; bytes as they are. */
export const bytesOf = (content) => (typeof content === "string" ? encoder.encode(content) : content);

/** Writes a file below a folder; throws an error that names it if a folder has its name, or a file that of its folder. */
export function writeFile(FS, folder, path, content) {
    const parts = cleanParts(path);
    let at = folder;
    try {
        for (const part of parts.slice(0, -1)) {
            at += `/${part}`;
            if (!FS.analyzePath(at).exists) FS.mkdir(at);
        }
        FS.writeFile(`${at}/${parts.at(-1)}`, bytesOf(content), { canOwn: true });
    } catch (error) {
        if (error.errno === undefined) throw error;
        throw new TypeError(`'${path}' cannot be a file: a folder has this name, or a file that of its folder`, { cause: error });
    }
}

/** Writes files, [path, content], below a folder, which is made if it is not there. */
export function fillFolder(FS, folder, files) {
    if (!FS.analyzePath(folder).exists) FS.mkdir(folder);
    for (const [path, content] of files) writeFile(FS, folder, path, content);
}

/** Removes a folder with all that it holds; the current one is then "/". */
export function removeFolder(FS, folder) {
    const remove = (path) => {
        if (!FS.isDir(FS.stat(path).mode)) return FS.unlink(path);
        for (const name of FS.readdir(path)) if (name !== "." && name !== "..") remove(`${path}/${name}`);
        return FS.rmdir(path);
    };
    FS.chdir("/");
    remove(folder);
}
