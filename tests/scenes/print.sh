# A report's page on paper: printed by chromium, read by poppler.
. tests/scenes/lib.sh
"$JOSTLE" run scenes/evacuation.yaml --for 60 --quiet --no-half-step --report "$work/page" >/dev/null 2>&1
verdict "a run with a report" $?
timeout 120 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" --no-pdf-header-footer --print-to-pdf="$work/page.pdf" "file://$work/page/index.html" >/dev/null 2>&1
pages=$(pdfinfo "$work/page.pdf" | sed -n 's/^Pages: *//p')
between "number of pages" "$pages" 8 18
pdfinfo "$work/page.pdf" | grep -q '^Page size: .*A4'; verdict "pages are A4" $?
pdftotext -l 1 -layout "$work/page.pdf" "$work/first.txt"
grep -q "Who got out when. All 140 people left" "$work/first.txt" && grep -q "Cleared? Yes" "$work/first.txt" && grep -q "What is validated, and what is not" "$work/first.txt"; verdict "the first page has all of the summary" $?
pdftotext "$work/page.pdf" - | tr -d '\f' >"$work/page.txt"
sed -n 's/^<h2>\(.*\)<\/h2>$/\1/p' "$work/page/index.html" >"$work/heads"
[ "$(grep -c . "$work/heads")" -ge 10 ] && [ "$(grep -xFf "$work/heads" "$work/page.txt" | awk '!seen[$0]++')" = "$(cat "$work/heads")" ]; verdict "all sections are there, in order" $?
pictures=$(grep -c '<img' "$work/page/index.html")
# pdfimages lists each picture once; a missing picture has no row.
between "number of pictures" "$(pdfimages -list "$work/page.pdf" | awk 'NR > 2 && $3 == "image" && $4 > 500' | sort -u -k11,11 | wc -l)" "$pictures" "$pictures"
pdftotext -bbox "$work/page.pdf" "$work/boxes"
[ "$(grep -c '<word' "$work/boxes")" -gt 500 ] && awk -F'"' '/<word/ && ($2 < 30 || $6 > 565) {print; bad = 1} END {exit bad}' "$work/boxes"; verdict "no word runs over the margins" $?
