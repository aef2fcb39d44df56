#!/bin/bash
# The playground: its modules and the checks of its lessons under node, then the site in a browser, from a file server below a
# sub-folder. Prints "ok NAME" or "not ok NAME: why". Needs build/site (`make site`); pictures go to $B/page with PICTURES set.
#     tests/site/run.sh [NAME...]    some of the tests
set -u
cd "$(dirname "$0")/../.."
export B=${B:-build/release} SITE=${SITE:-build/site}
export JOSTLE=${JOSTLE:-$B/jostle}
[ -f "$SITE/workbench.html" ] || { echo "not ok site: $SITE is not built (make site)"; exit 1; }
status=0
node tests/site/modules.mjs "$@" || status=1
for python in /usr/bin/python3 python3; do # another python3 on the path may not know Debian's packages
    if "$python" -c 'import selenium' 2>/dev/null; then
        "$python" tests/site/tests.py "$@" || status=1
        exit $status
    fi
done
echo "not ok site: python3-selenium is not installed (.ci/setup test)"
exit 1
