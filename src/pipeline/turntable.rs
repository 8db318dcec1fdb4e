//! Sequences of pictures of a mesh that turns, and films of them.

use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

use super::PipelineError;

/// Pictures a second of a film.
const RATE: u32 = 24;

/// The file of picture `index` of `count`: in its name a number stands for the run of #s, as wide as they are or as the last number is.
#[must_use]
pub fn numbered(path: &Path, index: u32, count: u32) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let Some(start) = name.find('#') else { return path.to_owned() };
    let marks = name[start..].chars().take_while(|mark| *mark == '#').count();
    let width = marks.max(count.saturating_sub(1).to_string().len());
    path.with_file_name(format!("{}{index:0width$}{}", &name[..start], &name[start + marks..]))
}

/// Whether ffmpeg can be run, which makes films.
///
/// # Errors
/// [`PipelineError::NoFfmpeg`].
pub fn check_ffmpeg() -> Result<(), PipelineError> {
    let ran = Command::new("ffmpeg").arg("-version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    match ran {
        Ok(status) if status.success() => Ok(()),
        _ => Err(PipelineError::NoFfmpeg),
    }
}

/// Makes the film `film` of the PNG files that are called `frames`, as [`numbered`] calls `count` of them. It appears whole or not at all.
///
/// # Errors
/// [`PipelineError::Ffmpeg`] with what ffmpeg says.
pub fn encode(frames: &Path, count: u32, film: &Path) -> Result<(), PipelineError> {
    let name = frames.file_name().unwrap_or_default().to_string_lossy();
    let marks = name.chars().filter(|mark| *mark == '#').count().max(count.saturating_sub(1).to_string().len());
    let start = name.find('#').unwrap_or_default();
    let end = name.rfind('#').map_or(start, |last| last + 1);
    // A % of the name itself would be taken for a mark.
    let pattern = format!("{}%0{marks}d{}", name[..start].replace('%', "%%"), name[end..].replace('%', "%%"));
    let input = frames.with_file_name(pattern);
    let unfinished = film.with_extension("part.mp4");
    let mut command = Command::new("ffmpeg");
    command.args(["-hide_banner", "-loglevel", "error", "-y", "-framerate", &RATE.to_string(), "-i"]).arg(&input);
    // Players want an even number of columns and rows, and this form of colour. Light that is not there is white.
    let filter = "[0]split[front][behind];[behind]drawbox=c=white:t=fill:replace=1[white];[white][front]overlay=format=auto,\
                  pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p";
    command.args(["-filter_complex", filter, "-c:v", "libx264", "-crf", "16", "-movflags", "+faststart"]).arg(&unfinished);
    let failed = |message: String| PipelineError::Ffmpeg { path: film.to_owned(), message };
    let output = command.stdin(Stdio::null()).output().map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).trim().to_owned()));
    }
    std::fs::rename(&unfinished, film).map_err(|error| failed(error.to_string()))
}
