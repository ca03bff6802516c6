/** The camera of all panes, as numbers that a link can hold. */
export interface Camera {
  /** Radians about the vertical axis; 0 is the front view. */
  yaw: number;
  /** Radians above the horizontal plane. */
  pitch: number;
  /** Zoom; 1 shows a whole shape in its pane. */
  zoom: number;
  /** Shift in the image, in radii of the shape. */
  x: number;
  y: number;
}

export const HOME: Camera = { yaw: 0.42, pitch: 0.08, zoom: 1, x: 0, y: 0 };

const STEEPEST = 1.5;
const ZOOMS = [0.4, 12] as const;

export function orbit(camera: Camera, yaw: number, pitch: number): Camera {
  const turn = (camera.yaw + yaw) % (2 * Math.PI);
  const rise = Math.min(STEEPEST, Math.max(-STEEPEST, camera.pitch + pitch));
  return { ...camera, yaw: turn, pitch: rise };
}

export function zoomBy(camera: Camera, factor: number): Camera {
  const [least, most] = ZOOMS;
  return { ...camera, zoom: Math.min(most, Math.max(least, camera.zoom * factor)) };
}

export function shift(camera: Camera, x: number, y: number): Camera {
  const bounded = (value: number) => Math.min(2, Math.max(-2, value));
  return { ...camera, x: bounded(camera.x + x), y: bounded(camera.y + y) };
}
