// Runs before the modules: starts the engine's worker and loads the scene that the address names, which both take longer than the modules.
// The page in the frame may ask for the engine before they run, and of files they do not run at all.
if (location.protocol !== "file:") {
    window.engineWorker = new Worker("worker.js", { type: "module", name: "first" });
    window.engineWorker.onerror = (event) => {
        window.engineWorker.early = event;
    };
    const scene = location.hash ? /^#scene=([\w-]+)$/.exec(location.hash)?.[1] : "dodgeball";
    if (scene) {
        const path = `data/scenes/${scene}.json`;
        window.earlyAnswer = { path, answer: fetch(path) };
        window.earlyAnswer.answer.catch(() => {}); // told by who takes it
    }
}

addEventListener("message", (event) => {
    if (event.origin !== location.origin || event.data?.jostle !== "connect") return;
    window.pagePort = event.ports[0];
    window.takePagePort?.();
});

addEventListener("DOMContentLoaded", () => {
    if (location.protocol !== "file:") return;
    const node = document.getElementById("notice");
    node.hidden = false;
    node.textContent = "Browsers run no modules of files. Serve this folder, as by: python3 -m http.server";
});
