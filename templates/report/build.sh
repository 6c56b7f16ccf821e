#!/bin/sh
# Bundle viewer.js with three.js, as the lock file fixes them, into viewer.min.js.
set -e
cd "$(dirname "$0")"
npm ci --no-audit --no-fund
npm run build
rm -rf node_modules
if grep -q ']]>' viewer.min.js; then
  echo "viewer.min.js holds ]]>, which would end its section in the page" >&2
  exit 1
fi
