# Builds the Python package offline and runs its tests.
set -u
. tests/scenes/lib.sh
python=/usr/bin/python3
case $B in build/release*) ;; *) echo "ok the Python package (left out: its library is that of a release build)"; exit ;; esac
if ! $python -c 'import cffi, numpy, pytest, setuptools' 2>/dev/null; then
    echo "not ok the Python package: python3-cffi, python3-numpy, python3-pytest or python3-setuptools is missing"
    exit
fi
cp -R scripts/python "$work/package"
(cd "$work/package" && JOSTLE_INCLUDE=$OLDPWD/core/include $python setup.py -q build --build-base "$work/made" --build-lib "$work/lib") >"$work/log" 2>&1
verdict "the Python package builds" $? ; grep -i error "$work/log" | head -5
export JOSTLE_LIBRARY=$(ls "$PWD/$B"/libjostle-tools.so.* | head -1) PYTHONPATH=$work/lib PYTHONDONTWRITEBYTECODE=1
$python -m pytest -p no:cacheprovider -v --tb=short scripts/python/tests >"$work/tests" 2>&1
sed -n 's/^.*::\([a-z_]*\(\[.*\]\)\{0,1\}\) PASSED.*$/ok python \1/p; s/^.*::\([a-z_]*\(\[.*\]\)\{0,1\}\) \(FAILED\|ERROR\).*$/not ok python \1/p' "$work/tests"
grep -q PASSED "$work/tests" || { echo "not ok the tests of the Python package ran"; tail -20 "$work/tests"; }
grep -E '^E  ' "$work/tests" | head -20
exit 0
