/** What cannot be read of a link is said, its address stays until that was seen, and nothing is opened without a word. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { compareByCommand, timeless } from "./command.mjs";
import {
  accessibilityFaults,
  button,
  card,
  downloadReport,
  openLink,
  shownMetrics,
  untilState,
  valueAt,
  withPage,
} from "./harness.mjs";
import { host } from "./hosts.mjs";

const RUN = "draws=400&perms=0";
const PLANES = `demo=planes&${RUN}`;

const notice = (page, code) => page.locator(`.notice[data-code="${code}"]`);
const fragment = (page) => page.evaluate(() => location.hash);
/** Longer than the page waits before it writes its address. */
const settle = (page) => page.waitForTimeout(1300);

test("what cannot be used is named, the address stays, and a reload names it again", async () => {
  await withPage({}, async ({ url, page }) => {
    const link = `#v=1&demo=planes&${RUN}&seed=-1&sigma=abc&foo=2`;
    await openLink(page, url, link.slice(1));
    const said = notice(page, "link-faults");
    for (const words of ["“seed=-1” of the link cannot be used", "Used instead: 1.", "“foo”"]) {
      await said.getByText(words).waitFor();
    }
    await settle(page);
    assert.equal(await fragment(page), link, "the address is not rewritten");
    assert.deepEqual(await accessibilityFaults(page), []);
    await page.reload();
    await untilState(page, "done");
    await said.getByText("“sigma=abc”").waitFor();
    // A change is a step of its own; before it the address is as it was given.
    await button(page, "Measures").click();
    await page.waitForFunction(() => location.hash.includes("room=measures"));
    await page.goBack();
    await page.waitForFunction(() => !location.hash.includes("room=measures"));
    await settle(page);
    assert.equal(await fragment(page), link);
    await said.getByRole("button", { name: "Dismiss" }).click();
    await page.waitForFunction(() => location.hash.includes("&seed=1&"));
    assert.doesNotMatch(await fragment(page), /abc|foo/);
  });
});

test("an example that there is not is named beside the one that is shown, also in an open page", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}#demo=heads`);
    const said = notice(page, "link-faults");
    await said.getByText("names the example “heads”, which there is not").waitFor();
    await said.getByText("The example “Heads: male and female” is shown instead.").waitFor();
    await untilState(page, "done");
    await settle(page);
    assert.equal(await fragment(page), "#demo=heads");
    await page.evaluate((next) => {
      location.hash = next;
    }, `v=1&${PLANES}`);
    await card(page, "A").getByRole("heading", { name: "planes-a" }).waitFor();
    assert.equal(await said.count(), 0, "of this link there is nothing to say");
    await page.evaluate((next) => {
      location.hash = next;
    }, `v=1&a=demo:stars-1-a&${RUN}`);
    await said.getByText("nothing as B; expected: two models.").waitFor();
  });
});

test("slips that mean one thing are corrected and said, with the numbers of the command", async () => {
  await withPage({}, async ({ url, page }) => {
    const link = `#v=1&amp;demo=Stars-2&amp;SIGMA=0,01&amp;draws=400&amp;perms=0).`;
    await openLink(page, url, link.slice(1));
    const said = notice(page, "link-repairs");
    await said.getByText("“&amp;” is read as “&”.").waitFor();
    await said.getByText("“sigma=0,01” is read as “sigma=0.01”.").waitFor();
    await said.getByText("“perms=0).” is read as “perms=0”.").waitFor();
    const report = await downloadReport(page);
    assert.deepEqual(timeless(report), timeless(compareByCommand("--link", link)));
    assert.equal(report.settings.sigma, 0.01);
    assert.equal(await fragment(page), link);
  });
});

test("the fingerprint of an example is checked, and the address keeps the one that was expected", async () => {
  await withPage({}, async ({ url, page }) => {
    const link = `v=1&a=demo:planes-a&b=demo:planes-b&hash-a=0123456789abcdef&${RUN}`;
    await openLink(page, url, link);
    const said = notice(page, "other-content");
    await said.getByText("0123456789abcdef was expected").waitFor();
    await settle(page);
    assert.equal(await fragment(page), `#${link}`, "or a reload would say nothing");
    await page.goto(`${url}#v=1&${PLANES}&hash-b=xyz`);
    await page.reload();
    await notice(page, "link-faults").getByText("“hash-b=xyz”").waitFor();
  });
});

test("a lesson names what it cannot use and takes the nearest bound", async () => {
  await withPage({ reducedMotion: "reduce" }, async ({ url, page }) => {
    const link = "v=1&page=learn&scene=planes&tilt=200&lift=x&foo=1";
    await openLink(page, url, link);
    const said = notice(page, "link-faults");
    await said.getByText("“tilt=200”").getByText("The nearest value is used instead.").waitFor();
    await said.getByText("“lift=x”").waitFor();
    await settle(page);
    assert.equal(await fragment(page), `#${link}`);
  });
});

test("a frame with an origin of its own compares what its link names", async () => {
  await withPage({}, async ({ url, page }) => {
    const link = `v=1&engine=0.2&demo=stars-2&sigma=0.01&${RUN}&embed=1`;
    const site = await host({
      "/": {
        type: "text/html",
        bytes: Buffer.from(
          `<!doctype html><title>A course</title><h1>A course</h1>
           <iframe width="900" height="500" sandbox="allow-scripts" src="${url}#${link}"></iframe>`,
        ),
      },
    });
    await page.goto(site.url);
    const frame = page.frameLocator("iframe");
    // It was never told that its worker may not start, and waited under the caption of the heads.
    await frame.getByText("A: star A. B: star B.").waitFor();
    await frame.locator('html[data-state="done"]').waitFor();
    const inner = page.frames()[1];
    assert.equal(await inner.evaluate(() => globalThis.origin), "null");
    const expected = compareByCommand("--link", link);
    const shown = await shownMetrics(inner);
    assert.ok(shown.length > 0, "there are numbers in the frame");
    for (const [path, value] of shown) assert.equal(value, valueAt(expected, path) + 0, path);
    await site.close();
  });
});
