/** Models by address, links of files, and what is given to others: codes, frames, commands. */
import assert from "node:assert/strict";
import { createHash } from "node:crypto";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { test } from "node:test";
import { root } from "../../scripts/steps/run.mjs";
import { compareByCommand, timeless } from "./command.mjs";
import {
  accessibilityFaults,
  card,
  downloadReport,
  dropFiles,
  fixture,
  metric,
  nextRun,
  openLink,
  untilCompared,
  untilDrawn,
  untilShown,
  untilState,
  withPage,
} from "./harness.mjs";
import { host } from "./hosts.mjs";

const bytesOf = (name) => readFile(fixture(name));
const PLANES = "v=1&demo=planes&draws=400";
const RUN = "draws=400&perms=0&seed=5";

const waiting = (page) => page.getByRole("region", { name: "Link" });
const notice = (page, code) => page.locator(`.notice[data-code="${code}"]`);
const fragment = (page) => page.evaluate(() => location.hash);

/** Goes to another link as somebody who pastes it. */
async function follow(page, link) {
  await page.evaluate((hash) => {
    location.hash = hash;
  }, link);
}

const openShare = async (page) => {
  await page.getByRole("button", { name: "Share" }).click();
  return page.getByRole("dialog", { name: "Share this comparison" });
};
const linkIn = (dialog) => dialog.getByRole("textbox", { name: /^Link/ }).inputValue();

test("two models by address are compared, and the link says which content they had", async () => {
  const files = await host({
    "/x/double.h5": await bytesOf("double.h5"),
    "/groups.h5": await bytesOf("bfm-groups.h5"),
  });
  await withPage({}, async ({ url, page, another }) => {
    const [a, b] = [`${files.url}/x/double.h5?download=1`, `${files.url}/groups.h5`];
    await page.goto(`${url}#v=1&a=${a}&b=${b}&part-b=expression&${RUN}`);
    await untilCompared(page, { a: "double.h5", b: "groups.h5" });
    const { models } = await downloadReport(page);
    const dialog = await openShare(page);
    const link = await linkIn(dialog);
    assert.ok(link.includes(`&hash-a=${models.a.fingerprint.slice(0, 16)}&`), link);
    assert.ok(link.includes(`&hash-b=${models.b.fingerprint.slice(0, 16)}&`), link);
    await dialog.getByText("The link contains the models, all settings").waitFor();

    // The same content later: nothing to say. Another one: it is told, and stays open.
    const later = await another();
    await later.goto(link);
    await untilCompared(later, { a: "double.h5", b: "groups.h5" });
    assert.equal(await notice(later, "other-content").count(), 0);
    const changed = await another();
    const other = "0123456789abcdef";
    await changed.goto(link.replace(/hash-a=\w+/, `hash-a=${other}`));
    await untilCompared(changed, { a: "double.h5", b: "groups.h5" });
    const text = await notice(changed, "other-content").innerText();
    assert.ok(text.includes(other) && text.includes(models.a.fingerprint.slice(0, 16)), text);
    assert.match(text, /“double\.h5” is not what the link was made with.*numbers may differ/s);
    assert.deepEqual(await accessibilityFaults(changed), []);
  });
  await files.close();
});

test("what cannot be downloaded is said in words, and what is open stays", async () => {
  const files = await host({
    "/page.h5": { type: "text/html", bytes: Buffer.from("\n<!DOCTYPE html><title>Log in</title>") },
    "/closed.h5": { status: 403, bytes: Buffer.from("no") },
    "/note.h5": Buffer.from(
      `version https://git-lfs.github.com/spec/v1\noid sha256:${"a".repeat(64)}\nsize 1234567\n`,
    ),
    "/wrong.h5": Buffer.from("no model"),
  });
  const shut = await host({ "/m.h5": await bytesOf("double.h5") }, { cors: false });
  await withPage({}, async ({ url, page, errors }) => {
    await openLink(page, url, PLANES);
    const shown = await metric(page, "overlap.varianceOfAInB");
    for (const [address, code, words] of [
      [`${files.url}/none.h5`, "not-found", /none\.h5 does not exist: localhost:\d+ answered 404/],
      [`${files.url}/closed.h5`, "forbidden", /closed\.h5 is not public: localhost/],
      [`${files.url}/page.h5`, "web-page", /is a web page, not a file of a model/],
      [`${files.url}/note.h5`, "lfs-pointer", /a Git LFS pointer to it: the file of 1\.23.MB/],
      [`${shut.url}/m.h5`, "not-shared", /does not let other sites read its files \(no Access-/],
      ["http://a.example/m.h5", "insecure-address", /read without encryption/],
      ["https://github.com/o/r/releases/download/1/m.h5", "not-shared", /release files of GitHub/],
      ["models/none.h5", "not-found", /models\/none\.h5 does not exist/],
    ]) {
      await follow(page, `v=1&a=${address}&b=demo:planes-b&draws=400`);
      await card(page, "A")
        .locator(`.notice[data-code="${code}"]`)
        .filter({ hasText: words })
        .waitFor();
      assert.equal(await card(page, "A").getByRole("heading").innerText(), "planes-a");
      assert.equal(await metric(page, "overlap.varianceOfAInB"), shown);
    }
    assert.deepEqual(await accessibilityFaults(page), []);
    await page.context().setOffline(true);
    await follow(page, `v=1&a=${files.url}/m.h5&b=demo:planes-b&draws=400`);
    await notice(page, "offline").filter({ hasText: "this computer is offline" }).waitFor();
    await page.context().setOffline(false);
    // The browser says of each that it failed.
    errors.length = 0;
  });
  await Promise.all([files.close(), shut.close()]);
});

test("a link whose model does not come keeps it in the address, and tries again", async () => {
  const all = {};
  const files = await host(all);
  await withPage({}, async ({ url, page, errors }) => {
    await page.goto(`${url}#v=1&a=${files.url}/double.h5&b=demo:heads-male&${RUN}`);
    await notice(page, "not-found").waitFor();
    // By then the page has written its address anew.
    await page.waitForTimeout(1300);
    assert.ok((await fragment(page)).includes(`a=${files.url}/double.h5&b=demo:heads-male`));
    all["/double.h5"] = await bytesOf("double.h5");
    await page.getByRole("button", { name: "Try again" }).click();
    await card(page, "A").getByText("Statismo").first().waitFor();
    errors.length = 0;
  });
  await files.close();
});

test("a download shows how far it is, and can be cancelled", async () => {
  let go = () => {};
  const wait = new Promise((done) => {
    go = done;
  });
  const bytes = Buffer.concat([await bytesOf("double.h5"), Buffer.alloc(8e6)]);
  const files = await host({
    "/slow.h5": { bytes, wait },
    "/vague.h5": { bytes, wait, length: null },
  });
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, PLANES);
    const read = (name) => follow(page, `v=1&a=${files.url}/${name}&b=demo:planes-b&draws=400`);
    await read("vague.h5");
    await card(page, "A")
      .getByText(/^Downloading: 4(\.\d+)?.MB so far$/)
      .waitFor();
    await read("slow.h5");
    await card(page, "A")
      .getByText(/^Downloading 4(\.\d+)? of 8\.\d+.MB$/)
      .waitFor();
    await card(page, "A").getByRole("button", { name: "Cancel" }).click();
    await card(page, "A").getByRole("heading", { name: "planes-a" }).waitFor();
    go();
    await untilState(page, "done");
    assert.equal(await page.locator(".notice").count(), 0);
  });
  await files.close();
});

test("what is large is asked about first; “Not now” leaves everything, and nobody is asked twice", async () => {
  const bytes = Buffer.concat([await bytesOf("double.h5"), Buffer.alloc(51e6)]);
  const files = await host({ "/large.h5": bytes, "/vague.h5": { bytes, length: null } });
  await withPage({}, async ({ url, page }) => {
    await openLink(page, url, PLANES);
    const link = (name) => `v=1&a=${files.url}/${name}&b=demo:heads-male&draws=400`;
    const question = page.locator(".consent");
    await follow(page, link("large.h5"));
    await question.getByText(/large\.h5 on localhost:\d+ is 51\.\d.MB\. Download it\?/).waitFor();
    assert.deepEqual(await accessibilityFaults(page), []);
    await question.getByRole("button", { name: "Not now" }).click();
    await question.waitFor({ state: "detached" });
    assert.equal(await card(page, "A").getByRole("heading").innerText(), "planes-a");
    assert.equal(await page.locator('.notice[data-code="not-downloaded"]').count(), 0);

    await follow(page, link("vague.h5"));
    await question.getByText(/vague\.h5 on localhost:\d+ is more than 50(\.0)?.MB/).waitFor();
    await question.getByRole("button", { name: "Download" }).click();
    await card(page, "A").getByText("51.0\u202fMB").waitFor();
    await page.goBack();
    await follow(page, `${link("vague.h5")}&seed=2`);
    await card(page, "A").getByText("51.0\u202fMB").waitFor();
    assert.equal(await question.count(), 0);
  });
  // With nothing else open it says so, and the way back is a button.
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}#v=1&a=${files.url}/large.h5&b=${files.url}/large.h5`);
    await page.getByRole("button", { name: "Not now" }).first().click();
    await page.getByRole("button", { name: "Not now" }).click();
    await card(page, "A").getByText("“large.h5” was not downloaded.").waitFor();
    await card(page, "A").getByRole("button", { name: "Try again" }).click();
    await page.getByRole("button", { name: "Download" }).click();
    await card(page, "A").getByText("51.0\u202fMB").waitFor();
  });
  await files.close();
});

test("a pointer of Git LFS on GitHub is followed, and what arrives is checked", async () => {
  const model = await bytesOf("double.h5");
  const pointer = (bytes, size = bytes.length) =>
    `version https://git-lfs.github.com/spec/v1\noid sha256:${createHash("sha256").update(bytes).digest("hex")}\nsize ${size}\n`;
  await withPage({}, async ({ url, page }) => {
    const headers = { "Access-Control-Allow-Origin": "*" };
    const pointers = {
      "/o/r/main/good.h5": pointer(model),
      "/o/r/main/bad.h5": pointer(Buffer.from("x"), model.length),
      "/o/r/main/long.h5": pointer(model, model.length + 1),
    };
    await page.route("https://raw.githubusercontent.com/**", (route) =>
      route.fulfill({ headers, body: pointers[new URL(route.request().url()).pathname] }),
    );
    await page.route("https://media.githubusercontent.com/media/o/r/main/*", (route) =>
      route.fulfill({ headers, body: model }),
    );
    const link = (name) =>
      `v=1&a=https://github.com/o/r/blob/main/${name}&b=demo:heads-male&draws=400`;
    await page.goto(`${url}#${link("good.h5")}`);
    await card(page, "A").getByText("Statismo").first().waitFor();
    await follow(page, link("bad.h5"));
    await notice(page, "lfs-content")
      .filter({ hasText: /SHA-256 [0-9a-f]{64} was expected/ })
      .waitFor();
    await follow(page, link("long.h5"));
    await notice(page, "lfs-content")
      .filter({ hasText: /size \d+ was expected, \d+ arrived/ })
      .waitFor();
    assert.equal(await card(page, "A").getByRole("heading").innerText(), "good.h5");
  });
});

test("a link of local files waits for the same files, and every number comes back", async () => {
  await withPage({}, async ({ url, page, another }) => {
    await openLink(page, url, `${PLANES}&seed=3&weighted=2048`);
    await dropFiles(page, "body", [fixture("double.h5"), fixture("bfm-groups.h5")]);
    await untilCompared(page, { a: "double.h5", b: "bfm-groups.h5" });
    const parts = card(page, "B").getByRole("combobox", { name: "Part of bfm-groups.h5" });
    const ran = await nextRun(page);
    await parts.selectOption("expression");
    await ran();
    await page.getByRole("button", { name: "Measures" }).click();
    const before = await downloadReport(page);
    assert.equal(before.models.b.modes, 3, "the part");
    const dialog = await openShare(page);
    await dialog.getByText("fingerprints of your two files, not the files.").waitFor();
    assert.deepEqual(await accessibilityFaults(page), []);
    const link = await linkIn(dialog);
    assert.match(
      link,
      /#v=1&engine=0\.2&name-a=double\.h5&name-b=bfm-groups\.h5&hash-a=[0-9a-f]{16}&hash-b=/,
    );
    await dialog.getByRole("checkbox", { name: "With the names of the files" }).uncheck();
    const nameless = await linkIn(dialog);
    assert.doesNotMatch(nameless, /double|groups/);
    await page.waitForTimeout(1300);
    assert.doesNotMatch(await fragment(page), /double|groups/, "the address bar has them no more");

    const other = await another();
    await other.goto(link);
    const hash = before.models.a.fingerprint.slice(0, 4);
    await waiting(other)
      .getByText(`The link was made with “double.h5” (${hash}…); open it as A.`)
      .waitFor();
    assert.deepEqual(await accessibilityFaults(other), []);
    assert.equal(await other.getByRole("combobox", { name: "Example" }).inputValue(), "");
    // Others are told, and compared all the same.
    await dropFiles(other, "body", [fixture("group.h5")]);
    await waiting(other)
      .getByText(/open it as [AB]\. What is open is “group\.h5”/)
      .waitFor();
    // In whatever order; the part is found in the file.
    await dropFiles(other, "body", [fixture("bfm-groups.h5"), fixture("double.h5")]);
    await untilCompared(other, { a: "double.h5", b: "bfm-groups.h5" });
    await untilShown(other, /seed 3/);
    await other.getByText("Both models are the ones that it was made with.").waitFor();
    assert.equal(
      await other.getByRole("button", { name: "Measures" }).getAttribute("aria-current"),
      "page",
    );
    assert.deepEqual(timeless(await downloadReport(other)), timeless(before));

    // After the page is loaded anew it waits for them again.
    await other.waitForTimeout(1300);
    await other.reload();
    await waiting(other).getByText("“double.h5”").waitFor();

    const third = await another();
    await third.goto(nameless);
    await waiting(third).getByText(`The link was made with a file (${hash}…)`).waitFor();
    await dropFiles(third, "body", [fixture("double.h5"), fixture("bfm-groups.h5")]);
    await third.getByRole("combobox", { name: "Part of bfm-groups.h5" }).selectOption("expression");
    await third.getByText("Both models are the ones that it was made with.").waitFor();
  });
});

test("one file and one example: the example is there, the file is waited for", async () => {
  await withPage({}, async ({ url, page, another }) => {
    await openLink(page, url, `v=1&demo=heads-sex&${RUN}`);
    const link = `${url}#v=1&a=demo:planes-a&name-b=mine.h5&hash-b=0123456789abcdef&${RUN}`;
    // In a page that shows something else nothing of that is lost before.
    await follow(page, new URL(link).hash);
    await card(page, "A").getByRole("heading", { name: "planes-a" }).waitFor();
    await waiting(page).getByText("“mine.h5” (0123…); open it as B. What is open is").waitFor();
    await waiting(page).getByRole("button", { name: "Discard" }).click();
    assert.equal(await waiting(page).count(), 0);

    const other = await another();
    await other.goto(link);
    await card(other, "A").getByRole("heading", { name: "planes-a" }).waitFor();
    await card(other, "B").getByRole("heading", { name: "mine.h5" }).waitFor();
    await waiting(other).getByText("“mine.h5” (0123…); open it as B.").waitFor();
    assert.match(
      await other.locator(".headline").innerText(),
      /Waiting for the models of the link/,
    );
    await dropFiles(other, "body", [fixture("double.h5")], { clientX: 1270, clientY: 400 });
    await card(other, "B").getByRole("heading", { name: "double.h5" }).waitFor();
    await waiting(other).getByRole("button", { name: "Use its settings for these" }).click();
    await other
      .getByRole("status", { name: "Link" })
      .getByText("With the settings of the link.")
      .waitFor();
    assert.equal(await other.getByText("Both models are the ones").count(), 0);
  });
});

/** What a camera reads of an element of the page. */
async function decoded(page, locator) {
  const picture = (await locator.screenshot()).toString("base64");
  await page.addScriptTag({ path: join(root, "node_modules/jsqr/dist/jsQR.js") });
  return page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes]));
    const pen = new OffscreenCanvas(image.width, image.height).getContext("2d");
    pen.drawImage(image, 0, 0);
    const { data } = pen.getImageData(0, 0, image.width, image.height);
    return globalThis.jsQR(data, image.width, image.height)?.data ?? null;
  }, picture);
}

for (const colorScheme of ["light", "dark"]) {
  test(`the dialog gives link, code and command of what is on show, in the ${colorScheme}`, async () => {
    const permissions = ["clipboard-read", "clipboard-write"];
    await withPage({ colorScheme, permissions }, async ({ url, page }) => {
      await page.goto(
        `${url}#v=1&demo=stars-3&sampler=hmc&${RUN}&modes=4&diff=relative&region=intersection`,
      );
      await untilState(page, "done");
      const report = await downloadReport(page);
      const dialog = await openShare(page);
      const copy = dialog.getByRole("button", { name: "Copy link" });
      await page.waitForFunction(() => document.activeElement?.textContent === "Copy link");
      await page.keyboard.press("Enter");
      await dialog.getByRole("button", { name: "Link copied" }).waitFor();
      const link = await linkIn(dialog);
      assert.equal(await page.evaluate(() => navigator.clipboard.readText()), link);
      assert.match(link, /demo=stars-3.*region=intersection/);
      assert.ok(await dialog.getByText(`(${link.length} characters)`).isVisible());
      await copy.waitFor();

      assert.equal(await decoded(page, dialog.getByRole("img", { name: "QR code" })), link);
      await dialog.getByText("In another web page").click();
      await dialog.getByText("On the command line").click();
      assert.deepEqual(await accessibilityFaults(page, ["moderate", "serious", "critical"]), []);
      const line = await dialog.getByRole("textbox", { name: "The same numbers" }).inputValue();
      const [, , ...args] = line.split(" ");
      assert.deepEqual(timeless(compareByCommand(...args)), timeless(report));

      await dialog.getByRole("button", { name: "Fill the screen" }).click();
      const full = page.getByRole("dialog", { name: "QR code of the link" });
      const { width, height } = await full.getByRole("img").boundingBox();
      assert.ok(Math.min(width, height) > 800 - 60, `${width} × ${height}`);
      assert.equal(await decoded(page, full), link);
      await page.keyboard.press("Escape");
      await full.waitFor({ state: "detached" });
      await page.keyboard.press("Escape");
      await dialog.waitFor({ state: "detached" });
      const focused = await page.evaluate(() => document.activeElement?.getAttribute("aria-label"));
      assert.equal(focused, "Share", "the focus is where it was");
    });
  });
}

test("on a phone everything in the dialog is within reach of a thumb", async () => {
  const phone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
  await withPage(phone, async ({ url, page }) => {
    await page.addInitScript(() => {
      navigator.share = async (what) => {
        globalThis.sent = what;
      };
    });
    await openLink(page, url, PLANES);
    const dialog = await openShare(page);
    await dialog.getByRole("img", { name: "QR code" }).waitFor();
    await dialog.getByText("In another web page").click();
    for (const button of await dialog.getByRole("button").all()) {
      const { height, width } = await button.boundingBox();
      assert.ok(Math.min(height, width) >= 44, `${await button.innerText()}: ${width} × ${height}`);
    }
    const scrolls = await dialog.evaluate((element) => element.scrollWidth > element.clientWidth);
    assert.equal(scrolls, false, "nothing is wider than the phone");
    await dialog.getByRole("button", { name: "Send…" }).click();
    const sent = await page.evaluate(() => globalThis.sent.url);
    assert.equal(sent, await linkIn(dialog));
  });
});

for (const [width, height] of [
  [400, 300],
  [800, 500],
]) {
  test(`a frame of ${width} × ${height} shows shapes, a caption and the way out of it`, async () => {
    const viewport = { width, height };
    await withPage({ viewport }, async ({ url, page }) => {
      await openLink(page, url, "v=1&demo=heads-sex&sigma=1&embed=1");
      await untilDrawn(page);
      for (const name of [".top", ".rail", ".tabs", ".toolbar"]) {
        assert.equal(await page.locator(name).filter({ visible: true }).count(), 0, name);
      }
      assert.equal(await page.evaluate(() => document.documentElement.dataset.embed), "");
      const { scrollHeight, scrollWidth } = await page.evaluate(() => {
        const { scrollHeight, scrollWidth } = document.documentElement;
        return { scrollHeight, scrollWidth };
      });
      assert.deepEqual([scrollWidth, scrollHeight], [width, height], "it fits");
      await page
        .getByText(/^A male head lies/)
        .first()
        .waitFor();
      assert.deepEqual(await accessibilityFaults(page), []);
      const [whole] = await Promise.all([
        page.waitForEvent("popup"),
        page.getByRole("link", { name: "Open in Shapevenn" }).click(),
      ]);
      await untilState(whole, "done");
      assert.match(whole.url(), /#v=1&engine=0\.2&demo=heads-sex&/);
      await whole.getByRole("button", { name: "Share" }).waitFor();
    });
  });
}

test("the element shows a comparison on a page of another site, and follows its attributes", async () => {
  await withPage({}, async ({ url, page }) => {
    const site = await host({
      "/": {
        type: "text/html",
        bytes: Buffer.from(
          `<!doctype html><title>A course</title><h1>A course</h1>
           <shape-venn demo="planes" title="Two planes" style="width: 640px; aspect-ratio: 16 / 10">
             <a href="${url}">Two planes</a>
           </shape-venn>
           <shape-venn class="plain" link="#v=1&demo=stars-1&draws=400&room=measures" serial></shape-venn>
           <script type="module" src="${url}shape-venn.js"></script>`,
        ),
      },
      "/double.h5": await bytesOf("double.h5"),
    });
    await page.goto(site.url);
    await page.evaluate(() => customElements.whenDefined("shape-venn").then(() => true));
    const box = await page.locator("shape-venn").first().boundingBox();
    assert.deepEqual([box.width, box.height], [640, 400]);
    const plain = await page.locator(".plain").boundingBox();
    assert.equal(plain.height, 420);
    const frame = page.frameLocator("shape-venn >> nth=0 >> iframe");
    await frame
      .getByText(/^A shape of plane A lies/)
      .first()
      .waitFor();
    await page
      .frameLocator(".plain >> iframe")
      .getByText(/^A shape of star A lies/)
      .first()
      .waitFor();
    await page
      .frameLocator(".plain >> iframe")
      .getByRole("heading", { name: /Grassmann/ })
      .first()
      .waitFor();
    assert.equal(
      await page.locator("shape-venn >> nth=0 >> iframe").getAttribute("title"),
      "Two planes",
    );

    const steps = await page.evaluate(() => history.length);
    await page.evaluate(() => {
      const element = document.querySelector("shape-venn");
      element.removeAttribute("demo");
      element.setAttribute("a", "double.h5");
      element.setAttribute("b", "demo:heads-male");
      element.setAttribute("title", "A file beside the page");
    });
    // These two cannot be compared, which the frame says too.
    await frame
      .getByRole("alert")
      .filter({ hasText: /points/ })
      .waitFor();
    assert.ok(site.asked.includes("/double.h5"), "the file is the one beside the page");
    await page.evaluate(() => {
      const element = document.querySelector("shape-venn");
      element.setAttribute("link", "v=1&demo=stars-2&draws=400&region=a");
    });
    await frame
      .getByText(/^A shape of star A lies/)
      .first()
      .waitFor();
    assert.equal(await page.evaluate(() => history.length), steps, "Back leads out of the course");
    await site.close();
  });
});

test("the example page of the element shows both of its frames", async () => {
  await withPage({}, async ({ url, page }) => {
    await page.goto(`${url}embed-example.html`);
    await page
      .frameLocator("shape-venn >> nth=0 >> iframe")
      .getByText(/^A male head lies/)
      .first()
      .waitFor();
    await page.locator("shape-venn").nth(1).scrollIntoViewIfNeeded();
    await page
      .frameLocator("shape-venn >> nth=1 >> iframe")
      .getByText(/^A shape of star A lies/)
      .first()
      .waitFor();
    assert.deepEqual(await accessibilityFaults(page), []);
  });
});
