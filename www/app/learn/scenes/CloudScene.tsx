export function CloudScene() {
  return <p>To come.</p>;
}
