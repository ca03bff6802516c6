/** Draws 3-D shapes with WebGL: one context, a scissored viewport per shape, drawn only on demand. */
import {
  DirectionalLight,
  HemisphereLight,
  Matrix4,
  PerspectiveCamera,
  Points,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Region } from "../../worker/protocol";
import type { Camera } from "../state/camera";
import { discardPane, move, type Pane, paint, paneOf, partsOf, sameShapes } from "./pane-objects";
import { pickVertex } from "./pick";
import { note, timesDrawing } from "./timing";
import {
  BLANK,
  cellsOf,
  type Frame,
  type Hit,
  halfHeightIn,
  type Moved,
  type PaneContent,
  type Rect,
  type Shot,
  type Viewer,
} from "./viewer";

const FIELD_OF_VIEW = 22;
/** Largest drawing buffer that browsers guarantee; larger pictures are drawn in parts. */
const LARGEST_TILE = 2048;

export class MeshViewer implements Viewer {
  #renderer: WebGLRenderer;
  #canvas: HTMLCanvasElement;
  #scene = new Scene();
  #eye = new PerspectiveCamera(FIELD_OF_VIEW);
  #sky = new HemisphereLight();
  #key = new DirectionalLight();
  #rim = new DirectionalLight();
  /** What is on the canvas; while another picture is drawn, that one. */
  #shot: Shot = BLANK;
  /** The panes on the canvas. */
  #panes: Pane[] = [];
  /** Objects of the last picture that is not on the canvas. */
  #last: Pane | null = null;
  #scheduled = 0;

  constructor(canvas: HTMLCanvasElement) {
    this.#canvas = canvas;
    this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.#renderer.setClearAlpha(0);
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.autoClear = false;
    this.#eye.add(this.#key, this.#key.target, this.#rim, this.#rim.target);
    this.#key.position.set(-0.55, 0.75, 1);
    this.#rim.position.set(0.9, 0.5, -0.8);
    this.#scene.add(this.#eye, this.#sky);
    canvas.addEventListener("webglcontextrestored", () => this.#request());
  }

  setLayout(width: number, height: number, layout: ReadonlyMap<Region, Rect>): void {
    if (width !== this.#shot.width || height !== this.#shot.height) {
      this.#renderer.setSize(width, height, false);
    }
    this.#change({ width, height, layout });
  }

  setMesh(panes: PaneContent[], frame: Frame): void {
    const former = this.#panes;
    this.#panes = panes.map((content) =>
      paneOf(
        content,
        former.find((pane) => sameShapes(pane.content, content)),
      ),
    );
    const used = new Set(this.#panes.flatMap((pane) => pane.objects));
    for (const { objects, ellipsoid } of former) {
      discardPane({ objects: objects.filter((object) => !used.has(object)), ellipsoid });
    }
    for (const pane of this.#panes) {
      paint(pane, this.#shot.range);
      for (const part of partsOf(pane)) this.#scene.add(part);
    }
    this.#change({ panes, frame });
  }

  morph(moved: readonly (Moved | null)[]): void {
    const begun = performance.now();
    moved.forEach((change, i) => {
      const pane = this.#panes[i];
      if (change && pane) move(pane, change, this.#shot.range);
    });
    this.#change({ panes: this.#panes.map(({ content }) => content) });
    note("normals and colours", begun);
  }

  setColors(range: readonly [number, number] | null): void {
    const former = this.#shot.range;
    if (range?.[0] === former?.[0] && range?.[1] === former?.[1]) return;
    for (const pane of this.#panes) paint(pane, range);
    this.#change({ range });
  }

  setCamera(camera: Camera): void {
    this.#change({ camera });
  }

  pick(x: number, y: number): Hit | null {
    for (const { content } of this.#panes) {
      const rect = this.#shot.layout.get(content.region);
      if (!rect || !contains(rect, x, y)) continue;
      const cells = cellsOf(rect, content.overlaid ? 1 : content.shapes.length, this.#shot.frame);
      const index = cells.findIndex((cell) => contains(cell, x, y));
      const cell = cells[index];
      const shape = content.shapes[index];
      if (!cell || !shape) return null;
      this.#aim(cell);
      const matrix = new Matrix4().multiplyMatrices(
        this.#eye.projectionMatrix,
        this.#eye.matrixWorldInverse,
      );
      const { width, height } = cell;
      const at = { x: x - cell.x, y: y - cell.y, width, height };
      const hit = pickVertex(shape, 3, matrix.elements, at);
      return hit && { region: content.region, vertex: hit.vertex, shape: index };
    }
    return null;
  }

  positionOf(region: Region, point: readonly number[]): { x: number; y: number } | null {
    const cell = this.#shot.layout.get(region);
    if (!cell) return null;
    this.#aim(cell);
    const { x, y } = vector(point).project(this.#eye);
    return { x: cell.x + ((x + 1) * cell.width) / 2, y: cell.y + ((1 - y) * cell.height) / 2 };
  }

  pointAt(region: Region, through: readonly number[], x: number, y: number): number[] | null {
    const cell = this.#shot.layout.get(region);
    if (!cell) return null;
    this.#aim(cell);
    const position = vector(through).project(this.#eye);
    position.x = (2 * (x - cell.x)) / cell.width - 1;
    position.y = 1 - (2 * (y - cell.y)) / cell.height;
    return position.unproject(this.#eye).toArray();
  }

  capture(scale: number, shot: Shot = this.#shot): HTMLCanvasElement {
    const copy = document.createElement("canvas");
    copy.width = Math.round(shot.width * scale);
    copy.height = Math.round(shot.height * scale);
    const pen = copy.getContext("2d");
    if (!pen) return copy;
    const [shown, ratio] = [this.#shot, this.#renderer.getPixelRatio()];
    try {
      this.#shot = shot;
      this.#renderer.setPixelRatio(1);
      this.#renderer.setScissorTest(false);
      this.#light();
      for (const content of shot.panes) {
        this.#withObjects(content, scale / ratio, (pane) =>
          this.#eachCell(pane, (cell) => this.#drawTiles(pen, cell, scale)),
        );
      }
    } finally {
      this.#shot = shown;
      this.#eye.clearViewOffset();
      this.#renderer.setPixelRatio(ratio);
      this.#renderer.setSize(shown.width, shown.height, false);
      // Before the next repaint, once for many pictures.
      this.#request();
    }
    return copy;
  }

  /** Calls `use` with the pane of a content: that on the canvas, or a new one, which is freed later. */
  #withObjects(content: PaneContent, enlarged: number, use: (pane: Pane) => void): void {
    const shown = this.#panes.find((pane) => pane.content === content);
    const pane = shown ?? paneOf(content);
    const dots = pane.objects.flatMap((object) =>
      object instanceof Points ? { material: object.material, size: object.material.size } : [],
    );
    try {
      if (!shown) {
        paint(pane, this.#shot.range);
        for (const part of partsOf(pane)) this.#scene.add(part);
      }
      // The size of points is in pixels, independent of the size of the picture.
      for (const { material, size } of dots) material.size = size * enlarged;
      use(pane);
    } finally {
      for (const { material, size } of dots) material.size = size;
      if (!shown) {
        for (const part of partsOf(pane)) part.removeFromParent();
        this.#letGo();
        this.#last = pane;
      }
    }
  }

  /** Frees objects later: with the last material its shader would be freed and compiled again for every picture. */
  #letGo(): void {
    if (this.#last) discardPane(this.#last);
    this.#last = null;
  }

  /** Draws one cell at its size in the picture, part by part. */
  #drawTiles(pen: CanvasRenderingContext2D, cell: Rect, scale: number): void {
    const [left, top] = [Math.round(cell.x * scale), Math.round(cell.y * scale)];
    const width = Math.max(1, Math.round(cell.width * scale));
    const height = Math.max(1, Math.round(cell.height * scale));
    const tile = { width: Math.min(width, LARGEST_TILE), height: Math.min(height, LARGEST_TILE) };
    const canvas = this.#canvas;
    // Setting the size of a canvas clears it.
    if (canvas.width !== tile.width || canvas.height !== tile.height) {
      this.#renderer.setSize(tile.width, tile.height, false);
    }
    this.#renderer.setViewport(0, 0, tile.width, tile.height);
    for (let y = 0; y < height; y += tile.height) {
      for (let x = 0; x < width; x += tile.width) {
        this.#eye.clearViewOffset();
        this.#aim(cell);
        this.#eye.setViewOffset(width, height, x, y, tile.width, tile.height);
        this.#renderer.clear();
        this.#renderer.render(this.#scene, this.#eye);
        const [w, h] = [Math.min(tile.width, width - x), Math.min(tile.height, height - y)];
        pen.drawImage(canvas, 0, 0, w, h, left + x, top + y, w, h);
      }
    }
  }

  dispose(): void {
    cancelAnimationFrame(this.#scheduled);
    this.#letGo();
    for (const pane of this.#panes) discardPane(pane);
    this.#renderer.dispose();
    // A page may have only a few contexts; without this the oldest one would be lost.
    this.#renderer.forceContextLoss();
  }

  #change(part: Partial<Shot>): void {
    this.#shot = { ...this.#shot, ...part };
    this.#request();
  }

  #request(): void {
    if (this.#scheduled !== 0) return;
    this.#scheduled = requestAnimationFrame(() => this.#render());
  }

  #render(): void {
    const begun = performance.now();
    this.#scheduled = 0;
    this.#renderer.setScissorTest(false);
    this.#renderer.clear();
    this.#light();
    for (const pane of this.#panes) this.#eachCell(pane, (cell) => this.#draw(cell));
    note("upload and draw calls", begun);
    if (timesDrawing()) this.#waitUntilDrawn();
  }

  /** Waits until the GPU has drawn, by reading a pixel. */
  #waitUntilDrawn(): void {
    const begun = performance.now();
    const context = this.#renderer.getContext();
    context.readPixels(0, 0, 1, 1, context.RGBA, context.UNSIGNED_BYTE, new Uint8Array(4));
    note("until it is drawn", begun);
  }

  /** Calls `draw` for each cell of a pane, while only the shapes of that cell are shown. */
  #eachCell({ content, objects, ellipsoid }: Pane, draw: (cell: Rect) => void): void {
    const { layout, frame } = this.#shot;
    const rect = layout.get(content.region);
    if (!rect || rect.width < 2 || rect.height < 2) return;
    cellsOf(rect, content.overlaid ? 1 : objects.length, frame).forEach((cell, at) => {
      for (const part of this.#panes.flatMap(partsOf)) part.visible = false;
      objects.forEach((object, i) => {
        object.visible = content.overlaid || i === at;
      });
      if (ellipsoid) ellipsoid.visible = true;
      draw(cell);
    });
  }

  #draw(cell: Rect): void {
    const bottom = this.#shot.height - cell.y - cell.height;
    this.#renderer.setViewport(cell.x, bottom, cell.width, cell.height);
    this.#renderer.setScissor(cell.x, bottom, cell.width, cell.height);
    this.#renderer.setScissorTest(true);
    this.#aim(cell);
    this.#renderer.render(this.#scene, this.#eye);
  }

  #aim(cell: Rect): void {
    const { frame, camera } = this.#shot;
    const { yaw, pitch, zoom, x, y } = camera;
    const halfHeight = halfHeightIn(cell, frame) / zoom;
    const distance = halfHeight / Math.tan((FIELD_OF_VIEW * Math.PI) / 360);
    const reach = Math.hypot(frame.halfWidth, frame.halfHeight) * 1.6;
    // The camera keeps its distance at any zoom; the field of view narrows instead.
    const away = Math.max(distance, reach * 1.5);
    const eye = this.#eye;
    eye.fov = (360 / Math.PI) * Math.atan(halfHeight / away);
    eye.aspect = cell.width / cell.height;
    eye.near = Math.max(away - reach * 1.4, away * 0.01);
    eye.far = away + reach * 1.4;
    const [cx, cy, cz] = frame.centre;
    eye.rotation.set(-pitch, yaw, 0, "YXZ");
    eye.position.set(x * frame.halfHeight, y * frame.halfHeight, away).applyEuler(eye.rotation);
    eye.position.x += cx;
    eye.position.y += cy;
    eye.position.z += cz;
    eye.updateProjectionMatrix();
    eye.updateMatrixWorld();
  }

  /** Flatter light for coloured maps. */
  #light(): void {
    const read = this.#shot.range !== null;
    this.#sky.color.set(0xffffff);
    this.#sky.groundColor.set(read ? 0xb8b8b8 : 0x8a8177);
    this.#sky.intensity = read ? 2.5 : 1.55;
    this.#key.intensity = read ? 0.9 : 2.0;
    this.#rim.intensity = read ? 0.2 : 0.9;
  }
}

function contains(rect: Rect, x: number, y: number): boolean {
  return x >= rect.x && y >= rect.y && x < rect.x + rect.width && y < rect.y + rect.height;
}

function vector(point: readonly number[]): Vector3 {
  return new Vector3(point[0], point[1], point[2]);
}
