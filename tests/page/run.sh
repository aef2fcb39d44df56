#!/bin/bash
# The live page in a browser without a display: the real page, served by the real program, with
# software graphics. Prints "ok NAME" or "not ok NAME: why"; pictures go to $B/page.
#     tests/page/run.sh [NAME...]    some of the tests
set -u
cd "$(dirname "$0")/../.."
export B=${B:-build/release}
export JOSTLE=${JOSTLE:-$B/jostle}
for python in /usr/bin/python3 python3; do # another python3 on the path may not know Debian's packages
    if "$python" -c 'import selenium' 2>/dev/null; then
        for browser in chromium chromedriver node; do
            command -v $browser >/dev/null || { echo "not ok page: $browser is not installed (.ci/setup test)"; exit 1; }
        done
        node tests/page/modules.mjs "$@"
        modules=$?
        "$python" tests/page/tests.py "$@" && exit $modules
        exit 1
    fi
done
echo "not ok page: python3-selenium is not installed (.ci/setup test)"
exit 1
