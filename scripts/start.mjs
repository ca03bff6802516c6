/** `npm start`: installs what is missing, builds what is out of date, serves, says where. */
import { build } from "./build.mjs";
import { serve } from "./serve.mjs";
import { main } from "./steps/run.mjs";

await main(async () => {
  await build();
  const { url } = await serve();
  console.log(`Shapevenn is at ${url} (Ctrl+C to stop).`);
});
