export function ModelTable() {
  return <section class="room" aria-label="Models" />;
}
