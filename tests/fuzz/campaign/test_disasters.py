"""A corrupt store, a full disk, a layout changed: said in one line, and finished work is kept."""

from __future__ import annotations

import resource
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from fuzz.campaign import identity
from fuzz.campaign.files import DATABASE
from fuzz.campaign.problems import CampaignError
from fuzz.campaign.session import Options, go_on
from fuzz.campaign.store import Store
from models.exit_codes import BAD_INPUT, DOES_NOT_HOLD, HOLDS, UNDECIDED
from tests.fuzz.campaign.quick import Quick
from tests.fuzz.campaign.totals import everything

ROOT = Path(__file__).resolve().parents[3]
BATCHES = 40


def run_on(folder: Path, quick: Quick | None = None, batches: int = BATCHES) -> int:
    return go_on(Options(folder, batches=batches, workers=2), [quick or Quick()])


def refused(folder: Path, quick: Quick | None = None, code: int = BAD_INPUT) -> str:
    with pytest.raises(CampaignError) as error:
        run_on(folder, quick)
    assert error.value.code == code
    assert len(str(error.value).splitlines()) == 1
    return str(error.value)


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("finished")
    assert run_on(folder) == HOLDS
    return folder


@pytest.fixture
def copied(finished: Path, tmp_path: Path) -> Path:
    return shutil.copytree(finished, tmp_path / "copied")


# ---- a corrupt store


@pytest.mark.parametrize("place", [0, 24, 5000, 20_000, 60_000], ids=lambda place: f"at {place}")
def test_a_damaged_store_is_named_and_left_as_it_is(copied: Path, place: int) -> None:
    path = copied / DATABASE
    content = bytearray(path.read_bytes())
    assert len(content) > place + 3000
    content[place : place + 3000] = b"\x5a" * 3000
    path.write_bytes(content)
    line = refused(copied)
    assert line.startswith(f"{path}: is damaged (")
    assert "put a copy in its place" in line
    assert path.read_bytes() == content


def test_a_store_that_is_cut_off_is_damaged(copied: Path) -> None:
    path = copied / DATABASE
    path.write_bytes(path.read_bytes()[: 9 * 4096 + 100])
    assert "is damaged" in refused(copied)


def test_another_database_is_not_taken_for_a_campaign(tmp_path: Path) -> None:
    with sqlite3.connect(tmp_path / DATABASE) as other:
        other.execute("CREATE TABLE sheep (name)")
    assert "is a database, and not of a campaign" in refused(tmp_path)


def test_a_store_of_another_version_is_left_to_it(copied: Path) -> None:
    with sqlite3.connect(copied / DATABASE) as other:
        other.execute("UPDATE identity SET value = 'heisoku campaign 0' WHERE thing = 'format'")
    assert "was made by heisoku campaign 0, and this is heisoku campaign 1" in refused(copied)


def test_another_version_of_what_computes_is_said(copied: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    was = identity.version_of("numpy")
    monkeypatch.setattr(identity, "version_of", lambda name: "1.0.0")
    line = refused(copied)
    assert f"numpy was {was} and is 1.0.0; put that back to go on, or name another folder" in line


# ---- a full disk


@pytest.fixture
def small_disk(tmp_path: Path) -> Iterator[Path]:
    folder = tmp_path / "disk"
    folder.mkdir()
    if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=300k", "none", str(folder)], check=False).returncode:
        pytest.skip("only root can make a small disk here")
    try:
        yield folder
    finally:
        subprocess.run(["umount", str(folder)], check=True)


def test_a_full_disk_is_said_and_the_campaign_goes_on_once_there_is_room(small_disk: Path, tmp_path: Path) -> None:
    line = refused(small_disk / "campaign", Quick(breaks=7), UNDECIDED)
    assert line.startswith(f"{small_disk / 'campaign'}")
    assert "was finished is kept" in line
    subprocess.run(["mount", "-o", "remount,size=8m", str(small_disk)], check=True)
    with Store(small_disk / "campaign") as store:
        assert 0 < store.totals()["quick"].batches < BATCHES
    assert run_on(small_disk / "campaign", Quick(breaks=7)) == DOES_NOT_HOLD
    assert run_on(tmp_path / "roomy", Quick(breaks=7)) == DOES_NOT_HOLD
    assert everything(small_disk / "campaign") == everything(tmp_path / "roomy")


def test_a_file_that_may_not_grow_is_said(tmp_path: Path) -> None:
    words = [sys.executable, "-m", "tests.fuzz.campaign.program", str(tmp_path), str(BATCHES), "0"]
    ended = subprocess.run(
        words,
        cwd=ROOT,
        text=True,
        capture_output=True,
        timeout=60,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (150_000, 150_000)),
    )
    assert ended.returncode == UNDECIDED
    assert len(ended.stderr.splitlines()) == 1, ended.stderr
    assert str(tmp_path / DATABASE) in ended.stderr
    assert "what was finished is kept" in ended.stderr
    with Store(tmp_path) as store:
        assert 0 < store.totals()["quick"].batches < BATCHES


# ---- what it is made from changes


def test_a_layout_changed_under_a_running_campaign_ends_it(tmp_path: Path) -> None:
    watched = tmp_path / "layout"
    watched.write_text("as it was", "utf-8")
    line = refused(tmp_path / "campaign", Quick(watched=watched, changes=20))
    # Whoever looks first says so: the campaign before a batch, or the worker that is given one.
    first = ("quick: changed under the running campaign: watched was", "began with: quick/watched was")
    assert any(words in line for words in first)
    with Store(tmp_path / "campaign") as store:
        before = store.totals()["quick"].batches
    assert before >= 20
    assert "its campaign was run with something else: quick/watched was" in refused(
        tmp_path / "campaign", Quick(watched=watched)
    )
    watched.write_text("as it was", "utf-8")
    assert run_on(tmp_path / "campaign", Quick(watched=watched)) == HOLDS
    with Store(tmp_path / "campaign") as store:
        assert store.totals()["quick"].batches == BATCHES


def test_a_layout_that_is_gone_is_said(tmp_path: Path) -> None:
    assert "gone: cannot be read any more" in refused(tmp_path / "campaign", Quick(watched=tmp_path / "gone"))


def test_layouts_are_kept_and_two_of_one_name_are_not_mixed_up(tmp_path: Path) -> None:
    for folder, text in (("one", "this"), ("other", "that")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "station.toml").write_text(text, "utf-8")
    with Store(tmp_path / "campaign") as store:
        store.keep_layouts([tmp_path / "one" / "station.toml"] * 2)
        with pytest.raises(CampaignError, match="is another layout of that name"):
            store.keep_layouts([tmp_path / "other" / "station.toml"])
        with pytest.raises(CampaignError, match="cannot be read"):
            store.keep_layouts([tmp_path / "third"])
    assert (tmp_path / "campaign" / "layouts" / "station.toml").read_text("utf-8") == "this"
