/** HTML that shows this comparison in another web page. Pure. */

/** A custom element from our own host; without JavaScript the link inside it stays. */
export function elementSnippet(address: string, title: string): string {
  const { base, fragment } = split(address);
  return [
    `<script type="module" src="${escaped(new URL("shape-venn.js", base).href)}"></script>`,
    `<shape-venn title="${escaped(title)}" link="${escaped(fragment)}">`,
    `  <a href="${escaped(address)}">${escaped(title)}</a>`,
    "</shape-venn>",
  ].join("\n");
}

/** Frame for pages that allow no scripts. `address` is that of the frame. */
export function frameSnippet(address: string, title: string): string {
  return `<iframe src="${escaped(address)}" title="${escaped(title)}" width="100%" height="420" style="border: 0" allow="fullscreen; clipboard-write" loading="lazy"></iframe>`;
}

function split(address: string): { base: string; fragment: string } {
  const [base = "", ...rest] = address.split("#");
  return { base, fragment: rest.join("#") };
}

function escaped(text: string): string {
  return text.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");
}
