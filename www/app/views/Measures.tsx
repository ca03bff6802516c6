export function Measures() {
  return <section class="room" aria-label="Measures" />;
}
