export function Diagnostics() {
  return <section class="room" aria-label="Diagnostics" />;
}
