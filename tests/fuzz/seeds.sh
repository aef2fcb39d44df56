# Sourced: `seeds NAME FOLDER` fills a folder with the inputs that the fuzzing of a target begins with. Of
# formats that belong to a version they are made by the program itself, $B/jostle.
seeds() {
    local name=$1 folder=$2 made=$2.made f
    rm -rf "$folder" "$made"
    mkdir -p "$folder"
    for f in tests/fuzz/seeds/"$name"/* tests/fuzz/found/"$name"/*; do
        [ -f "$f" ] && cp "$f" "$folder/"
    done
    case $name in
    scene) for f in scenes/*.yaml; do grep -q "^include\|count: [0-9][0-9][0-9][0-9]" "$f" || cp "$f" "$folder/"; done ;;
    behaviour) cp behaviours/*.lua tests/attacks/*.lua "$folder/" ;;
    input) cp scenes/*.input tests/data/*.input "$folder/" ;;
    checkpoint | recording | schema)
        mkdir -p "$made"
        "$B/jostle" run scenes/dodgeball.yaml --steps 2 --quiet --record "$made/recording" >/dev/null 2>&1
        case $name in
        recording) mv "$made/recording" "$folder/" ;;
        schema) sqlite3 "$made/recording" .dump >"$folder/recording" ;;
        checkpoint) "$B/jostle" run scenes/circle.yaml --set groups.crossing.count=4 --steps 4 --quiet --checkpoint 0.05 \
            --checkpoint-dir "$made" >/dev/null 2>&1; mv "$made/latest.checkpoint" "$folder/circle" ;;
        esac
        rm -rf "$made" ;;
    esac
    [ -n "$(ls "$folder")" ] || { echo "no seeds for $name" >&2; return 1; }
}
