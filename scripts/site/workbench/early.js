// Runs before the modules: the page in the frame may ask for the engine first, and modules of files do not run at all.
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
