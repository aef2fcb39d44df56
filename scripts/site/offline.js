// The service worker of the playground: keeps its files, so that it opens without a network. With one, the server's files are taken
// and kept. The build puts their names into data/files.json, and a number of the build at the end of this file.
const NAME = `jostle:${self.registration.scope}`;

async function keepAll() {
    const files = await (await fetch("data/files.json", { cache: "no-cache" })).json();
    await (await caches.open(NAME)).addAll(files.map((path) => new Request(path, { cache: "no-cache" })));
    await self.skipWaiting();
}

async function answer(request) {
    const cache = await caches.open(NAME);
    try {
        const fresh = await fetch(request);
        if (fresh.ok) cache.put(request, fresh.clone()).catch(() => {}); // a full disk costs only the next time without a network
        return fresh;
    } catch (error) {
        const kept = await cache.match(request, { ignoreSearch: true });
        if (!kept) throw error;
        return kept;
    }
}

addEventListener("install", (event) => event.waitUntil(keepAll()));
addEventListener("activate", (event) => event.waitUntil(self.clients.claim()));
addEventListener("fetch", (event) => {
    const { method, url } = event.request;
    if (method === "GET" && url.startsWith(self.registration.scope)) event.respondWith(answer(event.request));
});
