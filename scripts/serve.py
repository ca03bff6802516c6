"""Serves the folder it lies in, to this computer only: python3 serve.py [PORT]."""
import functools
import os
import sys
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

# The first two give the page all processors; without them (python3 -m http.server) it uses one.
HEADERS = {
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Embedder-Policy": "require-corp",
    "Cross-Origin-Resource-Policy": "cross-origin",
    "Access-Control-Allow-Origin": "*",
    "Cache-Control": "no-cache",
}


class Handler(SimpleHTTPRequestHandler):
    # Some systems call these something else, and browsers then refuse to run them.
    extensions_map = {**SimpleHTTPRequestHandler.extensions_map, ".js": "text/javascript", ".wasm": "application/wasm"}

    def end_headers(self):
        for name, value in HEADERS.items():
            self.send_header(name, value)
        super().end_headers()


if __name__ == "__main__":
    port = sys.argv[1] if len(sys.argv) > 1 else "8080"
    if not (port.isdigit() and int(port) < 65536):
        sys.exit(f"“{port}” is no port: a number up to 65535 was expected, as in python3 serve.py 9000.")
    folder = os.path.dirname(os.path.abspath(__file__))
    try:
        server = ThreadingHTTPServer(("127.0.0.1", int(port)), functools.partial(Handler, directory=folder))
    except OSError as error:
        sys.exit(f"Port {port} cannot be used: {error.strerror}. Choose another one: python3 serve.py 9000.")
    print(f"Shapevenn is at http://localhost:{server.server_port}/ until you press Ctrl+C.", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass
