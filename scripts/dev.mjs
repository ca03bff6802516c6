/** `npm run dev`: the engines as built, the page rebuilt as you edit. */
import { buildEngine } from "./build.mjs";
import { ensureNode } from "./setup.mjs";
import { main } from "./steps/run.mjs";

await main(async () => {
  await ensureNode();
  await buildEngine();
  const { createServer } = await import("vite");
  const server = await createServer();
  await server.listen();
  server.printUrls();
});
