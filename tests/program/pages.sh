#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT
source "$(dirname "${BASH_SOURCE[0]}")/support.bash"

# Every page that the program writes: complete, small, with words for what is shown.
make_toys
model=toys/model.safetensors
"$ism" detect --model $model --data toys/test.json -o found.json --report detect.html >/dev/null
"$ism" detect --model $model toys/test/test-0000.png -o one.json --report one.html --min-score 0 >/dev/null
"$ism" detect --model $model --data toys/test.json -o found.json --report "linked #1.html" --report-images link >/dev/null
"$ism" inspect --data toys/train.json --report inspect.html >inspect.txt
"$ism" info $model --report info.html --data toys/train.json >info.txt
"$ism" info $model --report plain.html >/dev/null
cp toys/report.html demo.html
for page in demo detect one "linked #1" inspect info plain; do
    page+=.html
    (($(wc -c <"$page") < 1000000)) || fail "$page: $(wc -c <"$page") bytes"
    ! grep -qE '<script|url\(|https?://[^w]|(src|href)="(/|file:|http)' "$page" || fail "$page needs other files"
    says 'name="viewport"' "$page"
    says "prefers-color-scheme: dark" "$page"
    ! grep -E '<svg viewBox' "$page" | grep -qvE 'role="img" aria-label="[^"]' || fail "$page: a figure without words"
done
says 'href="linked%20%231-images/1.jpg"' "linked #1.html"
! grep -q 'base64' "linked #1.html" || fail "linked pictures are in the page"
[[ -s "linked #1-images/1.jpg" ]] || fail "linked pictures are not beside the page"

# The folder of linked pictures is the page's own: photos in it are never written over, pictures of an earlier page do not stay.
mkdir trip-images
cp toys/test/test-0000.png trip-images/1.png
for page in trip.html "linked #1"; do  # the second would share the folder of "linked #1.html"
    refused_in_a_line "expected nothing but pictures of an earlier page '$page', got '" \
        "$ism" detect --model $model --data toys/test.json -o out --report "$page" --report-images link
done
refused_in_a_line "folder 'trip-images': expected nothing but" \
    "$ism" inspect --data toys/train.json --report trip.html --report-images link
refused_in_a_line "got '1.png'" "$ism" info $model --report trip.html --report-images link
cmp trip-images/1.png toys/test/test-0000.png || fail "a photo was written over"
echo x >plain-images
refused_in_a_line "expected a folder, got a file" "$ism" info $model --report plain.html --report-images link
"$ism" inspect --data toys/train.json --report album.html --report-images link >/dev/null
many=$(ls album-images | wc -l)
"$ism" detect --model $model toys/test/test-0000.png --report album.html --report-images link >/dev/null 2>&1
few=$(ls album-images | wc -l)
((few < many)) || fail "pictures of an earlier page stay: $(ls album-images)"
(($(grep -c . album-images/made-by-ism.txt) == few)) || fail "the list of pictures is another: $(ls album-images)"
"$ism" info $model --report album.htm --report-images link >/dev/null
[[ -d album.htm-images && -s album.htm ]] || fail "album.htm has no page of its own"
for command in "inspect --data toys/train.json" "info $model"; do
    refused_in_a_line "--report: expected a file, got standard output" "$ism" $command --report -
done
for text in "labelled object" "Mistakes: " "Precision and recall" "mean"; do says "$text" detect.html; done
says "as it was seen" info.html
sed -E 's/"category_id":[0-9]+/"category_id":1/' toys/train.json >toys/one-class.json
"$ism" train --data toys/one-class.json -o one-class --no-templates --no-depth >/dev/null
"$ism" info one-class --report many.html >/dev/null
says "Training objects: 12 of 24 are shown" many.html
! grep -q "are shown" info.html || fail "info.html: all 6 objects of each class fit, and yet some are left out"
! grep -q "as it was seen" plain.html || fail "words are shown without a data set"
for text in "images          " "car  " "size px"; do says "$text" inspect.txt; done
refused_in_a_line "expected an existing folder to write to, got none" \
    "$ism" inspect --data toys/train.json --report nowhere/out.html
refused_in_a_line "expected another file than an input, got one" "$ism" info $model --report $model
refused "--report" "$ism" info $model --data toys/train.json

# What looks wrong in a data set is told; a class's name is text in any script, and never markup.
sed -E 's/"depth_scale":0\.001/"depth_scale":0.03/; 0,/"depth_scale":0\.03/s//"depth_scale":1/; s/"name":"duck"/"name":"<b>\&鸭 بطة"/' toys/train.json >toys/odd.json
"$ism" inspect --data toys/odd.json --report odd.html >odd.txt
says "m away; depth_scale is 0.03 m per unit" odd.txt
says "file that cannot be used: 1" odd.txt
says "0.001 would make it" odd.txt
says "&lt;b&gt;&amp;鸭 بطة" odd.html
! grep -q '<b>' odd.html || fail "odd.html: a name became markup"

# Remarks of a kind are one line, names are short and in a line, and of two sizes the median is between them.
{
    printf '{"images":[{"id":1,"file_name":"toys/test/test-0000.png","width":320,"height":240}],"annotations":['
    printf '{"id":1,"image_id":1,"category_id":1,"bbox":[10,10,20,20]},{"id":2,"image_id":1,"category_id":1,"bbox":[90,90,40,40]}],'
    printf '"categories":[{"id":1,"name":"%0200d\\u001b"}' 0
    for number in {2..20}; do printf ',{"id":%d,"name":"c%d"}' $number $number; done
    printf ']}'
} >names.json
"$ism" inspect --data names.json --report names.html >names.txt
says "20 … 30 … 40" names.txt
says "classes without objects: c2, c3, c4, c5, c6, c7, c8, c9, c10, c11 and 9 more" names.txt
(($(grep -c "few examples" names.txt) == 1)) || fail "few examples: $(cat names.txt)"
awk 'length($0) > 100 && !/few examples/ {exit 1}' names.txt || fail "a long name makes the table wide: $(cat names.txt)"
! grep -q $'\x1b' names.txt || fail "a name goes to the terminal as it is"

# In a browser, on a phone and on a desk: nothing is wider than the screen, nothing is complained of.
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
if [[ -z $browser ]]; then
    echo "skipped: pages in a browser: no chromium (scripts/install_dependencies pages)"
    exit 77
fi
# browse <arguments...>: without what containers may lack, a display, a sandbox and shared memory
browse() {
    "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$PWD/browser" "$@"
}
browse --dump-dom "data:text/html,<p>seen" >seen.html 2>browser.err || true
if ! grep -q seen seen.html; then
    echo "skipped: pages in a browser: $browser does not start here: $(tail -n 1 browser.err)"
    exit 77
fi
# widths <page...>: "page screen widest" for each page and screen, told by a script in its copy; complaints in console.txt
widths() {
    local page number=0 frames=""
    for page in "$@"; do
        for screen in 390 1280; do
            cp "$page" "copy-$number.html"
            cat >>"copy-$number.html" <<END
<script>
for (const part of document.querySelectorAll("details")) part.open = true;
addEventListener("load", () => parent.postMessage(
    ["${page%% *}", $screen, document.documentElement.scrollWidth].join(" "), "*"));
</script>
END
            frames+="<iframe src=\"copy-$number.html\" style=\"width:${screen}px;height:800px;border:0\"></iframe>"
            number=$((number + 1))
        done
    done
    {
        echo '<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><pre></pre><script>'
        echo 'addEventListener("message", e => document.querySelector("pre").textContent += e.data + "\n")</script>'
        echo "$frames"
    } >frames.html
    browse --hide-scrollbars --enable-logging=stderr --virtual-time-budget=20000 \
        --dump-dom "file://$PWD/frames.html" 2>browser.err | sed -n '/<pre>/,/<\/pre>/p' |
        grep -oE '[a-z]+[^ >]* (390|1280) [0-9]+' | sort
    grep CONSOLE browser.err >console.txt || true
}
# what is wrong is noticed
printf '<!DOCTYPE html><p style="width:2000px">wide<script>console.error("wrong")</script>' >wide.html
[[ $(widths wide.html) == *'wide.html 390 20'* ]] || fail "a wide page is not noticed: $(widths wide.html)"
grep -q wrong console.txt || fail "a complaint is not noticed"
widths demo.html detect.html one.html "linked #1.html" inspect.html info.html plain.html odd.html names.html >widths.txt
(($(wc -l <widths.txt) == 18)) || fail "expected 9 pages on 2 screens, got: $(cat widths.txt browser.err)"
while read -r page screen widest; do
    ((widest <= screen)) || fail "$page is $widest pixels wide on a screen of $screen"
done <widths.txt
[[ ! -s console.txt ]] || fail "the browser complains: $(cat console.txt)"
