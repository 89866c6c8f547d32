//! The page of a solve that goes on: light fills in, the button stops the work.

use crate::browser::Browser;
use crate::support::{box_tri, folder_with};
use crate::watched::Watched;

#[test]
fn the_page_shows_light_on_its_way_and_stops_the_work() {
    let Some(mut browser) = Browser::start(1000, 600) else { return };
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = ["solve", "box.tri", "--elements", "4000", "--no-statement", "--converge", "1e-12"];
    let args = [&args[..], &["--schedule=single", "--no-overshoot", "-o", "a.csv"]].concat();
    let watched = Watched::start(folder.path(), &args);
    let address = format!("http://127.0.0.1:{}/{}/", watched.port, watched.token);
    browser.go(&address);
    browser.until("document.getElementById('camera')?.options.length > 0");
    // A point that was asked for is asked for again with each frame.
    browser.click(350.0, 250.0);
    let shots = "Number(/([\\d,]+) shots/.exec(document.getElementById('live-text').textContent)?.[1]\
                 .replaceAll(',', ''))";
    let first = browser.value(shots).as_f64().unwrap();
    let before = browser.number("[data-of=exitance-here][data-channel=g]");
    browser.until(&format!("{shots} > {first}"));
    browser.settle();
    let after = browser.number("[data-of=exitance-here][data-channel=g]");
    assert!(after >= before && after > 0.0, "{before} {after}");
    browser.value("document.getElementById('live-stop').click()");
    let (code, said) = watched.end();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("interrupted") && folder.path().join("a.csv").exists(), "{said}");
    browser.until("/solved|ended/.test(document.getElementById('live-text').textContent)");
    let asked = browser.requests();
    assert!(asked.iter().all(|a| a.starts_with(&address) || a.starts_with("data:")), "{asked:?}");
}
