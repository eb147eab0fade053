"""Charts in the figure that was drawn of them."""

from pathlib import Path

import pytest

from rovercheck import simulink_model
from rovercheck.checker.render.drawing.labels import arrows
from rovercheck.checker.render.drawing.own_figure import own_picture
from rovercheck.checker.render.statechart_svg import render
from rovercheck.checker.simulink.writer.packages import WrittenModel
from rovercheck.spec_model.lang.chart import Chart
from tests.simulink.samples import SAMPLES, package_of

CHARTS = {
    "1_lamp": "Lamp", "2_microwave": "Oven", "3_crossing": "Crossing", "4_smoother": "Smoother",
    "6_press": "Press",
}  # fmt: skip


def chart(sample: str) -> Chart:
    return simulink_model(package_of(sample)).chart(CHARTS[sample])


@pytest.mark.parametrize("sample", CHARTS)
def test_states_stand_as_they_are_drawn_and_all_is_inside(sample: str) -> None:
    shown = chart(sample)
    assert shown.figure is not None
    picture = own_picture(shown, shown.figure)
    boxes = {box.path: box for box in picture.boxes}
    assert boxes.keys() == {path for path in shown.states if path}
    assert {piece.arrow.name for piece in picture.pieces} == {arrow.name for arrow in arrows(shown)}
    for path, (x, y, *_) in shown.figure.frames.items():
        for other, (x1, y1, *_) in shown.figure.frames.items():
            assert (x < x1) == (boxes[path].x < boxes[other].x), "from left to right"
            assert (y < y1) == (boxes[path].y < boxes[other].y), "from top to bottom"
    for box in picture.boxes:
        assert 0 <= box.x and box.x + box.width <= picture.width
        assert 0 <= box.y and box.y + box.height <= picture.height
    for piece in picture.pieces:
        assert all(-9 <= x <= picture.width + 9 and -9 <= y <= picture.height + 9 for x, y in piece.points)


def test_active_states_history_and_labels_are_in_the_picture() -> None:
    told = render(chart("2_microwave"), ["Cooking.Heat"])
    assert 'class="state active" data-state="Cooking.Heat"' in told
    assert 'class="composite active" data-state="Cooking"' in told
    assert ">H</text>" in told and "[after(0.5, sec)]" in told and "[left == 0]/bell = true;" in told


def test_a_file_without_a_drawing_is_laid_out(tmp_path: Path) -> None:
    """Programs write all states in one place."""
    model = WrittenModel("same")
    block, drawn = model.root.chart("C")
    one, other = drawn.state("A"), drawn.state("B")
    drawn.frames = {one.ssid: (10, 10, 90, 60), other.ssid: (20, 20, 90, 60)}
    drawn.data("go", "input", "boolean")
    drawn.transition(None, one)
    drawn.transition(one, other, "[go]")
    source = model.root.inport("go", 1, OutDataTypeStr="boolean")
    model.root.line(source, f"{block}/1")
    found = simulink_model(model.save(tmp_path / "same.slx")).chart()
    assert found.figure is None and 'data-state="B"' in render(found)


def test_every_example_with_a_chart_is_here() -> None:
    assert {*CHARTS, "5_tank"} == {*SAMPLES}
