/**
 * <shape-venn>: a comparison of two shape models, or a lesson, as a frame in any page.
 *
 *   <script type="module" src="https://host/shapevenn/shape-venn.js"></script>
 *   <shape-venn demo="heads-sex" region="intersection" title="What male and female heads share">
 *     <a href="https://host/shapevenn/">What male and female heads share</a>
 *   </shape-venn>
 *
 * Attributes: demo, or a and b (addresses beside your page or anywhere that lets other sites read them); scene
 * of a lesson; room, region, view, sigma, seed; link, a whole fragment, which wins over all of these; title, for
 * people who do not see the frame; serial, to use one processor; loading, as of an <iframe>. Its size is yours:
 * 100 % × 420px unless your styles say otherwise. What is inside it stays until it works, and without JavaScript.
 */
const HOME = new URL("./", import.meta.url);

/** Attributes that are keys of a link, as they are. */
const KEYS = ["demo", "room", "region", "view", "sigma", "seed"];

const STYLE = `
  :host { display: block; position: relative; width: 100%; min-height: 0; contain: size; contain-intrinsic-height: 420px; }
  :host([hidden]) { display: none; }
  iframe { position: absolute; inset: 0; width: 100%; height: 100%; border: 0; border-radius: inherit; }
`;

class ShapeVenn extends HTMLElement {
  static observedAttributes = [...KEYS, "a", "b", "scene", "link", "title", "serial", "loading"];

  #frame = null;
  #shown = "";
  #waiting = false;

  connectedCallback() {
    if (!this.#frame) {
      const root = this.attachShadow({ mode: "open" });
      const style = document.createElement("style");
      style.textContent = STYLE;
      this.#frame = document.createElement("iframe");
      // The last one gives it all processors where the page around it may use them.
      this.#frame.allow = "fullscreen; clipboard-write; cross-origin-isolated";
      this.#update();
      root.append(style, this.#frame);
    }
  }

  /** Several attributes that change together are one change. */
  attributeChangedCallback() {
    if (!this.#frame || this.#waiting) return;
    this.#waiting = true;
    queueMicrotask(() => {
      this.#waiting = false;
      this.#update();
    });
  }

  #update() {
    const frame = this.#frame;
    frame.title = this.getAttribute("title") || "Shapevenn: a comparison of two shape models";
    frame.loading = this.getAttribute("loading") === "eager" ? "eager" : "lazy";
    const address = this.address;
    if (address === this.#shown) return;
    // A frame that is there already is told where to go: that adds no step to the Back button of the page, and
    // where only the fragment differs nothing is loaded anew.
    if (this.#shown === "" || !frame.contentWindow) frame.src = address;
    else frame.contentWindow.location.replace(address);
    this.#shown = address;
  }

  /** The address in the frame. */
  get address() {
    const address = new URL(HOME);
    if (this.hasAttribute("serial")) address.search = "serial";
    address.hash = this.#fragment();
    return address.href;
  }

  #fragment() {
    const whole = this.getAttribute("link");
    if (whole !== null) {
      const pairs = whole.slice(whole.indexOf("#") + 1);
      return /(^|&)embed=1(&|$)/.test(pairs) ? pairs : `${pairs}${pairs && "&"}embed=1`;
    }
    const pairs = [["v", "1"], ["embed", "1"]];
    const scene = this.getAttribute("scene");
    if (scene !== null) pairs.push(["page", "learn"], ["scene", scene]);
    for (const side of ["a", "b"]) {
      const model = this.getAttribute(side);
      // Beside the page that says so, not beside this script.
      if (model !== null) pairs.push([side, /^demo:/.test(model) ? model : new URL(model, document.baseURI).href]);
    }
    for (const key of KEYS) {
      if (this.hasAttribute(key)) pairs.push([key, this.getAttribute(key)]);
    }
    return pairs.map(([key, value]) => `${key}=${value.replace(/[%&#+\s]/g, encodeURIComponent)}`).join("&");
  }
}

if (!customElements.get("shape-venn")) customElements.define("shape-venn", ShapeVenn);
