/** Tests which file an address means, and with what words addresses are refused. */
import assert from "node:assert/strict";
import { test } from "node:test";
import type { EngineFailure } from "../../../worker/engine-errors";
import { readLink } from "../../link/link";
import { adviceOf, verdictOf } from "../../link/runfile/expected";
import { expectedByLink } from "../../link/waiting";
import { fileAddress, fileName, looksLikeAddress } from "./address";
import { behindPointer, pointerIn } from "./lfs";

const PAGE = "https://shapes.example/venn/index.html";
const file = (text: string, page = PAGE) => fileAddress(text, page).href;
const refusal = (text: string, page = PAGE): EngineFailure => {
  try {
    const found = fileAddress(text, page);
    return assert.fail(`${text} is read as ${found}`);
  } catch (thrown) {
    return thrown as EngineFailure;
  }
};

test("an address of a file is that file; one beside the page is beside the page", () => {
  assert.equal(file("https://a.example/m.h5?x=1#part"), "https://a.example/m.h5?x=1#part");
  assert.equal(file("models/m.h5"), "https://shapes.example/venn/models/m.h5");
  assert.equal(file("/m.h5"), "https://shapes.example/m.h5");
});

test("pages that show a file mean the file", () => {
  const raw = "https://raw.githubusercontent.com/owner/repo";
  const pages = {
    "https://github.com/owner/repo/blob/main/a/m.h5": `${raw}/main/a/m.h5`,
    "https://github.com/owner/repo/raw/v1.0/m.h5": `${raw}/v1.0/m.h5`,
    "https://github.com/owner/repo/raw/refs/heads/x/y/m.h5": `${raw}/refs/heads/x/y/m.h5`,
    "https://github.com/owner/repo/blob/main/m.h5?raw=true#L1": `${raw}/main/m.h5`,
    "https://gist.github.com/owner/0123456789abcdef01234567":
      "https://gist.githubusercontent.com/owner/0123456789abcdef01234567/raw",
    "https://gist.github.com/owner/0123456789abcdef01234567/raw/9f/m.json":
      "https://gist.githubusercontent.com/owner/0123456789abcdef01234567/raw/9f/m.json",
    "https://gitlab.com/group/sub/project/-/blob/main/a/m%201.h5":
      "https://gitlab.com/api/v4/projects/group%2Fsub%2Fproject/repository/files/a%2Fm%201.h5/raw?ref=main&lfs=true",
    "https://git.lab.example/g/p/-/raw/v2/m.h5":
      "https://git.lab.example/api/v4/projects/g%2Fp/repository/files/m.h5/raw?ref=v2&lfs=true",
    "https://huggingface.co/owner/model/blob/main/m.npz":
      "https://huggingface.co/owner/model/resolve/main/m.npz",
    "https://huggingface.co/datasets/o/d/raw/main/x/m.npz":
      "https://huggingface.co/datasets/o/d/resolve/main/x/m.npz",
    "https://zenodo.org/records/123/files/m.h5?download=1":
      "https://zenodo.org/api/records/123/files/m.h5/content",
    "https://zenodo.org/record/123/preview/m.h5":
      "https://zenodo.org/api/records/123/files/m.h5/content",
  };
  for (const [page, expected] of Object.entries(pages)) assert.equal(file(page), expected, page);
});

test("a repository of one of these hosts that looks like a page elsewhere is left alone", () => {
  for (const address of [
    "https://raw.githubusercontent.com/owner/repo/main/m.h5",
    "https://example.org/owner/repo/blob/main/m.h5",
    "https://zenodo.org/api/records/123/files/m.h5/content",
  ]) {
    assert.equal(file(address), address);
  }
});

test("without encryption only this computer and the page's own site are read", () => {
  for (const host of ["localhost:8000", "127.0.0.1", "[::1]:81", "models.localhost"]) {
    assert.equal(file(`http://${host}/m.h5`), `http://${host}/m.h5`);
  }
  const failure = refusal("http://a.example/m.h5");
  assert.equal(failure.code, "insecure-address");
  assert.match(failure.message, /^http:\/\/a\.example\/m\.h5 is read without encryption/);
  assert.match(failure.message, /mixed content/);
  assert.match(failure.hint, /Use https:\/\/ if a\.example has it/);
  assert.equal(refusal("http://127.0.0.1.example/m.h5").code, "insecure-address");
  const plain = "http://lab.example/venn/";
  assert.equal(file("m.h5", plain), "http://lab.example/venn/m.h5");
  assert.equal(refusal("//other.example/m.h5", plain).code, "insecure-address");
});

test("hosts that let no other site read their files are told from the address", () => {
  for (const [address, host] of [
    ["https://github.com/o/r/releases/download/v1/m.h5", /release files of GitHub/],
    ["https://github.com/o/r/releases/latest/download/m.h5", /release files of GitHub/],
    ["https://www.dropbox.com/scl/fi/x/m.h5?rlkey=y&dl=0", /Dropbox/],
    ["https://drive.google.com/file/d/x/view", /Google Drive/],
  ] as const) {
    const { code, message, hint } = refusal(address);
    assert.equal(code, "not-shared");
    assert.match(message, host);
    assert.match(message, /Access-Control-Allow-Origin/);
    assert.match(hint, /drop it here; or put the file/);
  }
});

test("what is no address of the web is none", () => {
  for (const text of ["javascript:alert(1)", "file:///etc/passwd", "data:,x", "https://", ""]) {
    assert.equal(looksLikeAddress(text), false, text);
    assert.equal(refusal(text).code, "no-address");
  }
  assert.equal(refusal("https://[broken/m.h5").code, "no-address");
});

test("a file is called by what people see in its address", () => {
  assert.equal(fileName("https://a.example/x/male%20head.h5?download=1"), "male head.h5");
  assert.equal(fileName("https://zenodo.org/api/records/1/files/m.h5/content"), "m.h5");
  assert.equal(fileName("https://a.example/100%.h5"), "100%.h5");
  assert.equal(fileName("models/m.h5"), "m.h5");
});

const POINTER =
  "version https://git-lfs.github.com/spec/v1\n" +
  `oid sha256:${"4d7a".repeat(16)}\nsize 325000000\n`;

test("a pointer of Git LFS is told from a model, and followed on GitHub only", () => {
  assert.deepEqual(pointerIn(POINTER), { sha256: "4d7a".repeat(16), size: 325_000_000 });
  for (const other of [
    "",
    `x${POINTER}`,
    POINTER.replace("spec/v1", "spec/v2"),
    POINTER.replace("sha256", "md5"),
    POINTER.replace(/size.*/, "size many"),
    POINTER + "x".repeat(1024),
  ]) {
    assert.equal(pointerIn(other), null);
  }
  const raw = new URL("https://raw.githubusercontent.com/o/r/main/a/m.h5");
  assert.equal(
    behindPointer(raw)?.href,
    "https://media.githubusercontent.com/media/o/r/main/a/m.h5",
  );
  assert.equal(behindPointer(new URL("https://a.example/m.h5")), null);
});

const HASH = "0123456789abcdef";

test("a link waits for the files that it names, and knows them by the start of their fingerprint", () => {
  const link = readLink(`v=1&a=demo:heads-male&name-b=b.h5&hash-b=${HASH}&seed=9`);
  const run = expectedByLink(link);
  assert.equal(run?.settings.seed, "9");
  assert.equal(run?.models.a.source, "demo:heads-male");
  const { b } = run?.models ?? assert.fail("it waits for nothing");
  assert.deepEqual(b, {
    name: "b.h5",
    source: null,
    part: null,
    reading: "",
    fingerprint: HASH,
  });
  const open = (fingerprint: string) => ({ report: { name: "x.h5", fingerprint }, source: null });
  assert.equal(verdictOf(b, open(`${HASH}${HASH}`)), "same");
  assert.equal(verdictOf(b, open(`f${HASH}${HASH}`)), "other");
  assert.equal(
    adviceOf(b, null, "b", "link"),
    "The link was made with “b.h5” (0123…); open it as B.",
  );
  const nameless = expectedByLink(readLink(`v=1&hash-a=${HASH}&hash-b=${HASH}`));
  assert.match(
    adviceOf(nameless?.models.a ?? b, null, "a", "link") ?? "",
    /made with a file \(0123…\)/,
  );
});

test("a link of examples or addresses alone waits for nothing", () => {
  const hash = `&hash-a=${HASH}`;
  for (const link of [
    "",
    "v=1&demo=planes",
    `v=1&a=demo:planes-a&b=https://b.example/m.h5${hash}`,
  ]) {
    assert.equal(expectedByLink(readLink(link)), null);
  }
});
