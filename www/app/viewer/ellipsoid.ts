/** Draws the covariance ellipsoid of a vertex in 3-D, translucent, with its three principal ellipses. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  type Object3D,
  SphereGeometry,
  SRGBColorSpace,
  Vector3,
} from "three";
import type { DrawnEllipsoid } from "./viewer";

const STEPS = 48;
/** Opacity in front of surfaces and behind them. */
const [BEFORE, BEHIND] = [0.22, 0.1];

export function ellipsoidObject({ centre, axes, ink }: DrawnEllipsoid): Object3D {
  const [r, g, b] = ink;
  const color = new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
  const solid = new SphereGeometry(1, STEPS, STEPS / 2);
  const shared = { color, transparent: true, depthWrite: false };
  const parts = [
    new Mesh(solid, new MeshBasicMaterial({ ...shared, opacity: BEFORE })),
    new Mesh(solid, new MeshBasicMaterial({ ...shared, opacity: BEHIND, depthTest: false })),
    new LineSegments(
      circles(),
      new LineBasicMaterial({ ...shared, opacity: 0.85, depthTest: false }),
    ),
  ];
  const group = new Group();
  // Drawn after all surfaces.
  parts.forEach((part, i) => {
    part.renderOrder = 1 + i;
  });
  group.add(...parts);
  const axis = (i: number) => new Vector3().fromArray(axes, 3 * i);
  group.matrix.copy(new Matrix4().makeBasis(axis(0), axis(1), axis(2)));
  group.matrix.setPosition(centre[0] ?? 0, centre[1] ?? 0, centre[2] ?? 0);
  group.matrixAutoUpdate = false;
  return group;
}

export function discardEllipsoid(group: Object3D): void {
  group.removeFromParent();
  for (const part of group.children) {
    const { geometry, material } = part as Mesh;
    geometry.dispose();
    (material as Material).dispose();
  }
}

/** Unit circles in the three coordinate planes. */
function circles(): BufferGeometry {
  const points: number[] = [];
  const at = (plane: number, step: number) => {
    const angle = (2 * Math.PI * step) / STEPS;
    const point = [0, 0, 0];
    point[plane] = Math.cos(angle);
    point[(plane + 1) % 3] = Math.sin(angle);
    return point;
  };
  for (let plane = 0; plane < 3; plane += 1) {
    for (let step = 0; step < STEPS; step += 1)
      points.push(...at(plane, step), ...at(plane, step + 1));
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(points), 3));
  return geometry;
}
