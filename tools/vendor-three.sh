#!/usr/bin/env bash
# Makes crates/animate/vendor/three.bundle.js from the npm registry and compares it with the one that is there;
# with --accept it takes its place. Needs Node.js and npm; building the workspace needs neither.
set -euo pipefail
cd "$(dirname "$0")/../crates/animate/vendor"

work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

# --ignore-scripts: esbuild's binary comes as a package of its own, nothing has to be run to install it.
npm install --prefix "$work" --no-audit --no-fund --ignore-scripts --save-exact three@0.187.0 esbuild@0.28.2 >&2
cp three.entry.js "$work/"
(cd "$work" && npx --no-install esbuild three.entry.js --bundle --minify --format=iife --global-name=THREE \
    --legal-comments=inline --charset=utf8 --target=es2020 --outfile=three.bundle.js >&2)

sha256sum "$work/three.bundle.js" | cut -d' ' -f1
if [ "${1:-}" = --accept ]; then
    cp "$work/three.bundle.js" three.bundle.js
    cp "$work/node_modules/three/LICENSE" LICENSE-three
elif cmp -s "$work/three.bundle.js" three.bundle.js; then
    echo 'the bundle is as committed' >&2
else
    echo 'the bundle differs from the committed one' >&2
    exit 1
fi
