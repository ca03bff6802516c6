export function ModelScene() {
  return <p>To come.</p>;
}
